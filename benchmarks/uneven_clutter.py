# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of ships, and how many tracks follow nobody, where false plots are not everywhere?

Run ``python -m benchmarks.uneven_clutter [--runs N] [--set NAME=VALUE ...]``. A marine radar, 24
turns a minute, with ``config/marine_radar.yaml`` and a range of 22 km, ten minutes among ten
ships; so many false plots a turn are rain in a square of 4 km, waves within 4 km, a coast, or even
in range and azimuth, and five more are anywhere. First as nothing else is set: the density is
learnt where it is; then with the true mean told as `clutter_density`, which is what a tracker
without a map goes by. Mean and standard error over the runs; false are confirmed tracks of nobody
at a time.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from tqdm import tqdm

from benchmarks.dense_clutter import HEAD, line, Outcome
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Floats, Plots
from tracking_core.config import with_values
from tracking_tools.parameter_file import parse_value, read_parameter_file

PRESET = Path(__file__).parent.parent / 'config' / 'marine_radar.yaml'
TURN_TIME, FARTHEST, DETECTION = 2.5, 22e3, 0.85  # [s], [m]
SD = np.array([40.0, 0.009])  # of range [m] and azimuth [rad]
SHIPS, ANYWHERE, LOOKS = 10, 5.0, 240
Rng = np.random.Generator
Source = Callable[[Rng, int], Floats]  # polar plots (M, 2)


def _even(rng: Rng, count: int) -> Floats:
    return rng.uniform([50.0, -np.pi], [FARTHEST, np.pi], (count, 2))


def _rain(rng: Rng, count: int) -> Floats:
    return _polar(rng.uniform([6e3, -2e3], [10e3, 2e3], (count, 2)))


def _waves(rng: Rng, count: int) -> Floats:
    return rng.uniform([50.0, -np.pi], [4e3, np.pi], (count, 2))


def _coast(rng: Rng, count: int) -> Floats:
    return rng.uniform([8e3, 0.3], [14e3, 1.3], (count, 2))


CASES: tuple[tuple[str, Source, tuple[float, ...]], ...] = (
    ('even', _even, (30.0, 100.0)),
    ('waves', _waves, (30.0, 100.0, 200.0)),
    ('rain', _rain, (30.0, 100.0)),
    ('coast', _coast, (30.0, 100.0)),
)


def watch(source: Source, false_plots: float, seed: int, is_told: bool, **own: Any) -> Outcome:
    """Return what it makes of so many false plots of this kind a turn; `own` are parameters."""
    rng, values = np.random.default_rng(seed), read_parameter_file(PRESET, '/radar_tracker')
    told = (false_plots + ANYWHERE) / (2.0 * np.pi * (FARTHEST - 50.0)) if is_told else 0.0
    values.update({'scan.assembly': 'snapshot', 'sensor.range_max': FARTHEST, **own})
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**values, 'clutter_density': told}))
    start = _cartesian(rng.uniform([1e3, -np.pi], [15e3, np.pi], (SHIPS, 2)))
    velocity = _cartesian(rng.uniform([2.0, -np.pi], [12.0, np.pi], (SHIPS, 2)))
    rows = []
    for k in range(LOOKS):
        ships = start + TURN_TIME * k * velocity
        seen = _polar(ships[rng.random(SHIPS) < DETECTION])
        place = np.concatenate([
            seen + SD * rng.standard_normal(seen.shape), source(rng, rng.poisson(false_plots)),
            _even(rng, rng.poisson(ANYWHERE)),
        ])  # fmt: skip
        plots = Plots.polar(np.full(len(place), TURN_TIME * k), place[:, 0], place[:, 1])
        begin = process_time()
        tracks = tracker.track(replace(plots, stamp=TURN_TIME * k))
        cost = process_time() - begin
        mean = tracks.planes[0].average[tracks.confirmed][:, [0, 2]]
        radius = np.maximum(300.0, 4.0 * SD[1] * np.hypot(*ships.T))
        near = np.hypot(*(mean[:, None] - ships).transpose(2, 0, 1)) < radius
        rows.append((near.any(axis=0), (~near.any(axis=1)).sum(), len(tracks), cost))
    return Outcome(*map(np.array, zip(*rows, strict=True)))


def _cartesian(polar: Floats) -> Floats:
    return polar[:, :1] * np.column_stack([np.cos(polar[:, 1]), np.sin(polar[:, 1])])


def _polar(place: Floats) -> Floats:
    return np.column_stack([np.hypot(*place.T), np.arctan2(place[:, 1], place[:, 0])])


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='Ships in rain, waves and before a coast.')
    parser.add_argument('--runs', type=int, default=10, help='of ten minutes each')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args(arguments)
    own = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    print(HEAD)
    for is_told in (False, True):
        for name, source, amounts in CASES:
            title = f'{name}, mean told' if is_told else name
            for amount in amounts:
                seeds = tqdm(range(given.runs), desc=f'{title}, {amount:.0f}', leave=False)
                outcomes = [watch(source, amount, seed, is_told, **own) for seed in seeds]
                print(line(title, amount, outcomes), flush=True)


if __name__ == '__main__':
    main()
