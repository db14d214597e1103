# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where do tracks cross in bearing, and how well is each contact held?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from msg_adapters.table import Columns
from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle
from tracking_tools.bearing_scene import BearingScene
from tracking_tools.evaluation.judging import RADIUS
from tracking_tools.scene import of_id

CLOSE = RADIUS['sonar']  # a track so near to a contact may be its own


@dataclass(frozen=True)
class Crossing:
    """Two tracks that change sides."""

    ids: tuple[int, int]
    time: float  # [s]
    bearing: float  # [rad]
    start: float  # from when to when they are near each other [s]
    end: float


@dataclass(frozen=True)
class Hearing:
    """One contact and the tracks that were on it."""

    contact: int
    duration: float  # it could be heard [s]
    share: float  # of that with a track on it
    tracks: tuple[int, ...]  # in order of time
    error: float  # of the bearing, root mean square [rad]
    range_error: float  # of the last range that was told [m], NaN: none was
    range_sd: float  # ... as told [m]


def find_crossings(tracks: Columns, near: float) -> list[Crossing]:
    """Return all crossings of tracks, in order of time; `near` is a difference [rad]."""
    ids = [int(number) for number in np.unique(tracks.get('id', ()))]
    found = [c for pair in combinations(ids, 2) for c in _crossings(tracks, pair, near)]
    return sorted(found, key=lambda crossing: crossing.time)


def _crossings(tracks: Columns, pair: tuple[int, int], near: float) -> Iterator[Crossing]:
    one, other = (of_id(tracks, number) for number in pair)
    time, first, second = np.intersect1d(one['stamp'], other['stamp'], return_indices=True)
    apart = wrap_angle(one['bearing'][first] - other['bearing'][second])
    close = np.abs(apart) < near
    changes = np.flatnonzero((apart[:-1] * apart[1:] < 0.0) & close[:-1])
    for at in changes[:1]:  # noise may make several of one
        wide = np.flatnonzero(~close)
        start = time[max(wide[wide < at], default=0)]
        end = time[min(wide[wide > changes[-1]], default=len(time) - 1)]
        middle = (at + changes[-1] + 1) // 2
        yield Crossing(
            pair, float(time[middle]), float(one['bearing'][first][middle]), float(start),
            float(end),
        )  # fmt: skip


def find_hearings(scene: BearingScene) -> list[Hearing]:
    """Return how each true contact was held; a track belongs to the contact it is nearest to."""
    return [_hearing(scene, int(number)) for number in np.unique(scene.truth.get('id', ()))]


def _hearing(scene: BearingScene, contact: int) -> Hearing:
    path, tracks = of_id(scene.truth, contact), scene.tracks
    off = wrap_angle(tracks['bearing'] - bearing_at(path, tracks['stamp']))
    inside = (tracks['stamp'] >= path['time'][0]) & (tracks['stamp'] <= path['time'][-1])
    mine = inside & (np.abs(off) < CLOSE) & (_owner(scene) == contact)
    ids, first = np.unique(tracks['id'][mine], return_index=True)
    held = len(np.unique(tracks['stamp'][mine]))
    told = np.flatnonzero(mine & (tracks['observable'] > 0))
    last = told[-1:]
    true = np.interp(tracks['stamp'][last], path['time'], path['range'])
    error = np.abs(tracks['range'][last] - true)
    return Hearing(
        contact,
        float(np.ptp(path['time'])),
        held / len(path['time']),
        tuple(int(number) for number in ids[np.argsort(first)]),
        float(np.sqrt(np.mean(off[mine] ** 2))) if mine.any() else np.nan,
        float(error[0]) if len(told) else np.nan,
        float(tracks['range_sd'][last][0]) if len(told) else np.nan,
    )


def _owner(scene: BearingScene) -> Floats:
    """Return the contact of each row's track: that which it was nearest to most of the time."""
    tracks, truth = scene.tracks, scene.truth
    contacts = np.unique(truth['id'])
    off = np.full((len(tracks['id']), len(contacts)), np.inf)
    for column, contact in enumerate(contacts):
        path = of_id(truth, contact)
        there = (tracks['stamp'] >= path['time'][0]) & (tracks['stamp'] <= path['time'][-1])
        apart = np.abs(wrap_angle(tracks['bearing'] - bearing_at(path, tracks['stamp'])))
        off[there, column] = apart[there]
    nearest = off.argmin(axis=1)
    ids, row = np.unique(tracks['id'], return_inverse=True)
    votes = np.zeros((len(ids), len(contacts)))
    np.add.at(votes, (row, nearest), off.min(axis=1) < CLOSE)
    return np.asarray(contacts[votes.argmax(axis=1)][row], np.float64)


def bearing_at(path: Columns, time: Floats) -> Floats:
    """Return the bearing (N,) [rad] of a path at other times (N,) [s], in a turn of its own."""
    return np.interp(time, path['time'], np.unwrap(path['bearing']))
