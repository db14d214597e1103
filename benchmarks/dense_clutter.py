# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
When are contacts found among hundreds of false plots, and how many tracks follow nobody?

Run ``python -m benchmarks.dense_clutter [--runs N]``. Five contacts at 200 m/s within 50 km, a
look every 4 s, P_D 0.9, plots of 80 m, speed limit 600 m/s, 40 looks; set is what stands in front
of a row. Look 1 is the first one. Mean and standard error over the runs; the losing rows are 600
false plots as nothing is set, no faint starts, and M of N.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import process_time
from typing import Any

import numpy as np
from tqdm import tqdm

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Bools, Floats, Ints, Plots
from tracking_core.config import with_values

INTERVAL, RANGE, SD, DETECTION = 4.0, 50e3, 80.0, 0.9  # [s], [m], [m]
CONTACTS, SPEED, START = 5, 200.0, 30e3  # [m/s]; start within so many metres of the middle
RADIUS = 600.0  # a track farther off follows somebody else [m]
LOOKS, SETTLED = 40, 10  # held and false tracks are counted after so many
FALSE_PLOTS = (20, 40, 80, 150, 300, 600)
# What is set, and among how many false plots it is tried.
CASES = (
    ({}, FALSE_PLOTS),
    ({'initiation.faint_starts': 0}, (40, 80)),
    ({'initiation.faint_starts': 200}, (600, 1000)),
    ({'lifecycle': 'm_of_n'}, FALSE_PLOTS),
)
HEAD = (
    f'{"set":28}{"false plots":>12}{"look":>14}{"found":>8}{"held":>17}{"false tracks":>17}'
    f'{"tracks":>8}{"CPU ms":>8}'
)


@dataclass(frozen=True)
class Outcome:
    """What became of the contacts of one run, look by look."""

    held: Bools  # (K, C) by a confirmed track
    false: Ints  # (K,) confirmed tracks that follow nobody
    tracks: Ints  # (K,) tentative ones included
    cost: Floats  # (K,) CPU [s]

    @property
    def found(self) -> Floats:
        """Number of the look (C,) that confirmed a contact, NaN: none did."""
        return np.where(self.held.any(axis=0), self.held.argmax(axis=0) + 1.0, np.nan)


def watch(false_plots: float, seed: int, looks: int = LOOKS, **values: Any) -> Outcome:
    """Return what a tracker makes of so many false plots a look; `values` are parameters."""
    rng = np.random.default_rng(seed)
    tracker = RadarTracker(
        with_values(
            RadarTrackerConfig(),
            {
                'scan.assembly': 'snapshot',
                'sensor.position_sd': SD,
                'sensor.detection_probability': DETECTION,
                'sensor.range_max': RANGE,
                'clutter_density': false_plots / (np.pi * RANGE**2),
                **values,
            },
        )
    )
    start, velocity = _within(START, CONTACTS, rng), SPEED * _directions(CONTACTS, rng)
    rows = []
    for k in range(looks):
        place = start + INTERVAL * k * velocity
        seen = place[rng.random(CONTACTS) < DETECTION]
        clutter = _within(RANGE, rng.poisson(false_plots), rng)
        position = np.concatenate([seen + rng.normal(0.0, SD, seen.shape), clutter])
        plots = Plots.cartesian(np.full(len(position), INTERVAL * k), position)
        begin = process_time()
        tracks = tracker.track(replace(plots, stamp=INTERVAL * k))
        cost = process_time() - begin
        mean = tracks.planes[0].estimate('mmse')[0][tracks.confirmed][:, [0, 2]]
        near = np.hypot(*(mean[:, None] - place).transpose(2, 0, 1)) < RADIUS
        rows.append((near.any(axis=0), (~near.any(axis=1)).sum(), len(tracks), cost))
    return Outcome(*map(np.array, zip(*rows, strict=True)))


def _directions(count: int, rng: np.random.Generator) -> Floats:
    angle = rng.uniform(-np.pi, np.pi, count)
    return np.column_stack([np.cos(angle), np.sin(angle)])


def _within(distance: float, count: int, rng: np.random.Generator) -> Floats:
    """Return points (count, 2) spread evenly over a disc."""
    return distance * np.sqrt(rng.random(count))[:, None] * _directions(count, rng)


def line(name: str, false_plots: float, outcomes: Sequence[Outcome]) -> str:
    """Return the row of the table."""
    found = np.concatenate([o.found for o in outcomes])
    known = found[np.isfinite(found)]
    when = f'{known.mean():5.1f} +- {_error(known):.1f}' if len(known) else 'never'
    held = np.array([o.held[SETTLED:].mean() for o in outcomes])
    false = np.array([o.false[SETTLED:].mean() for o in outcomes])
    tracks = np.mean([o.tracks[SETTLED:] for o in outcomes])
    cost = 1e3 * np.median([o.cost[SETTLED:] for o in outcomes])
    return (
        f'{name:28}{false_plots:12.0f}{when:>14}{np.isfinite(found).mean():8.2f}'
        f'{held.mean():8.3f} +- {_error(held):.3f}{false.mean():8.3f} +- {_error(false):.3f}'
        f'{tracks:8.0f}{cost:8.2f}'
    )


def _error(values: Floats) -> float:
    return float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else np.nan


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='Contacts among hundreds of false plots.')
    parser.add_argument('--runs', type=int, default=20, help='of five contacts each')
    given = parser.parse_args(arguments)
    print(HEAD)
    for values, amounts in CASES:
        name = ' '.join(f'{key}: {value}' for key, value in values.items())
        for false_plots in amounts:
            seeds = tqdm(range(given.runs), desc=f'{name}, {false_plots}', leave=False)
            outcomes = [watch(false_plots, seed, **values) for seed in seeds]
            print(line(name, false_plots, outcomes), flush=True)


if __name__ == '__main__':
    main()
