# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How well are the contacts of a simulated scene tracked, all of it or a part?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from time import process_time
from typing import Any

import numpy as np

from benchmarks.simulated_scene import Part, Range, Scene
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Bools, Floats
from tracking_core.config import with_values
from tracking_core.rows import take
from tracking_tools.scoring import confirmed_rows, continuity, join_rows, Stretches, TrackRows
from tracking_tools.scoring.accuracy import track_error
from tracking_tools.scoring.matching import candidates, choose_pairs
from tracking_tools.scoring.siap import nearest

SETTLED = 10  # from this look at it on a contact ought to be held; false tracks are counted then
SLACK = 3  # looks that a contact goes straight on after its truth ends


@dataclass(frozen=True)
class Figures:
    """How well it went, in the columns of the table."""

    held: float  # share of the looks at all contacts, from the tenth at each, with a track on it
    found: float  # looks to the first confirmed track; of those that had one
    tracks: float  # confirmed ones a contact, over the same looks as `held`
    ids: float  # new ones of a contact, after the first
    false: float  # confirmed tracks near nobody, at a time
    nees: float  # of all tracks on contacts, position and velocity; 1: the covariance is right
    mean: float  # CPU of a look [ms]
    worst: float


def play(scene: Scene, values: Mapping[str, Any]) -> tuple[TrackRows, Floats]:
    """Return the confirmed tracks after each look, and its CPU (K,) [s]; `values` over its own."""
    config = with_values(RadarTrackerConfig(), {**scene.values, **values})
    tracker, parts, cost = RadarTracker(config), [], []
    for look, plots in enumerate(scene.messages):
        begin = process_time()
        tracks = tracker.track(plots, scene.platform)
        cost.append(process_time() - begin)
        parts.append(confirmed_rows(look, tracks, config.output))
    rows = join_rows(parts)
    is_fast = np.linalg.norm(rows.velocity, axis=1) >= scene.slowest
    return take(rows, is_fast), np.array(cost)


def judge(scene: Scene, rows: TrackRows, cost: Floats) -> list[Figures]:
    """Return the figures of each part of the scene."""
    stamps = np.array([plots.stamp for plots in scene.messages])
    near = candidates(rows, scene.truth, scene.radius, SLACK * float(np.median(np.diff(stamps))))
    matches, on = choose_pairs(near, scene.radius), nearest(near)
    is_false = np.ones(len(rows), bool)
    is_false[near.row] = False
    found = []
    for part in scene.parts:
        looks, wanted = _asked(scene, part, stamps)
        mine = take(on, wanted[on.scan, on.contact])
        there = scene.there & _chosen(part.contacts, wanted.shape[1])
        whole, kept = (
            continuity(rows, matches, near.track, _stretches(which)) for which in (there, wanted)
        )
        false = is_false & looks[rows.scan] & part.has(rows.position)
        found.append(Figures(
            kept.held, whole.latency + 1.0, len(mine) / wanted.sum(),
            kept.lasting_switches / wanted.any(axis=0).sum(), false.sum() / looks.sum(),
            track_error(rows, mine).nees_state, 1e3 * cost[looks].mean(), 1e3 * cost[looks].max(),
        ))  # fmt: skip
    return found


def _asked(scene: Scene, part: Part, stamps: Floats) -> tuple[Bools, Bools]:
    """Return which looks (K,) belong to a part, and when (K, C) it wants which contact held."""
    looks = _chosen(part.looks, len(stamps)) & (np.arange(len(stamps)) >= SETTLED)
    wanted = scene.there & (np.cumsum(scene.there, axis=0) >= SETTLED) & looks[:, None]
    wanted[:, ~_chosen(part.contacts, wanted.shape[1])] = False
    for contact in np.flatnonzero(wanted.any(axis=0)):
        place = scene.truth.of_contact(int(contact)).at(stamps)
        wanted[:, contact] &= part.has(place.position)
    return looks, wanted


def _chosen(some: Range, count: int) -> Bools:
    chosen = np.zeros(count, bool)
    chosen[slice(*some)] = True
    return chosen


def _stretches(wanted: Bools) -> Stretches:
    """Return the runs of looks (K, C) in which contacts are wanted."""
    edge = np.diff(wanted.T.astype(int), axis=1, prepend=0, append=0)
    contact, first = np.nonzero(edge == 1)
    return Stretches(contact, first, np.nonzero(edge == -1)[1] - 1)


NAMES = ('scene, and what is set', 'held', 'looks', 'tracks', 'new ids', 'false', 'NEES', 'CPU ms')
HEAD = '| ' + ' | '.join(NAMES) + ' |\n' + '|---' * len(NAMES) + '|'


def line(name: str, runs: Sequence[Figures]) -> str:
    """Return a row of the table: mean and standard error over the runs."""
    columns = np.array([astuple(run) for run in runs]).T
    cost = f'{columns[6].mean():.1f}, at most {columns[7].max():.0f}'
    return '| ' + ' | '.join([name, *map(mean_of, columns[:6]), cost]) + ' |'


def mean_of(values: Floats) -> str:
    """Return mean and standard error of what is known, in words."""
    known = values[np.isfinite(values)]
    if len(known) < 2:
        return f'{known[0]:.3g}' if len(known) else 'never'
    error = known.std(ddof=1) / np.sqrt(len(known))
    return f'{known.mean():.3g} +- {error:.1g}' if error > 0.0 else f'{known.mean():.3g}'
