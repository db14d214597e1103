# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Are two manoeuvring aircraft that cross in clutter kept apart? 100 scans, 100 runs.

Run ``python -m benchmarks.crossing [--runs N] [--seed N] [--set NAME=VALUE ...]``. GOSPA with
c = 1 km, p = 2, alpha = 2 is the mean over all scans of all runs, those before the tracks are
confirmed included.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import process_time
from typing import Any

import numpy as np

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_tools.parameter_file import parse_value
from tracking_tools.scenarios import build, plots, Scenario, SimulatedScan
from tracking_tools.scoring import (
    confirmed_rows,
    continuity,
    gospa_of_scans,
    join_rows,
    match,
    Stretches,
    TrackRows,
    Truth,
)  # fmt: skip

CUTOFF = 1000.0  # [m]
PARAMETERS: dict[str, Any] = {
    'sensor.range_sd': 10.0,
    'sensor.azimuth_sd': float(np.deg2rad(0.1)),
    'sensor.detection_probability': 0.8,
    'sensor.range_min': 1000.0,
    'sensor.range_max': 40_000.0,
    # Straight flight, gentle and hard manoeuvres; nothing is known of the turns to come.
    'motion.horizontal.acceleration_sd': [0.05, 2.0, 7.0],
    'motion.horizontal.sojourn_time': [100.0, 40.0, 30.0],
    'motion.horizontal.turn_rate': [0.0, 0.0, 0.0],
    'initiation.speed_max': 200.0,
}


@dataclass(frozen=True)
class Outcome:
    """One run."""

    gospa: float  # mean over the scans [m]
    localisation: float  # root mean square over the scans [m]
    missed: float  # contacts a scan
    false: float  # tracks a scan
    switches: int
    milliseconds: float  # CPU of a scan


def run(scenario: Scenario, config: RadarTrackerConfig, seed: int) -> Outcome:
    """Play the scenario once and judge the tracks."""
    scans = list(plots(scenario, np.random.default_rng(seed)))
    tracker, parts = RadarTracker(config), []
    begin = process_time()
    for k, scan in enumerate(scans):
        parts.append(confirmed_rows(k, tracker.track(_message(scan))))
    spent = process_time() - begin
    return _judge(scans, join_rows(parts), 1e3 * spent / len(scans))


def _message(scan: SimulatedScan) -> Plots:
    c = scan.columns
    return replace(Plots.polar(c['time'], c['range'], c['azimuth']), stamp=scan.start)


def _judge(scans: Sequence[SimulatedScan], rows: TrackRows, cost: float) -> Outcome:
    passes = [scan.truth for scan in scans]
    truth = Truth.of(
        np.concatenate([p.id for p in passes]),
        np.concatenate([p.time for p in passes]),
        np.concatenate([p.position for p in passes])[:, :2],
        np.concatenate([p.velocity for p in passes])[:, :2],
    )
    times = np.array([scan.start for scan in scans])
    parts = gospa_of_scans(rows, truth, times, cutoff=CUTOFF)
    matches = match(rows, truth, CUTOFF)
    stretches = Stretches(np.unique(truth.id), np.zeros(2, np.int64), np.full(2, len(scans) - 1))
    return Outcome(
        gospa=float(np.mean([p.total for p in parts])),
        localisation=float(np.sqrt(np.mean([p.localisation for p in parts]))),
        missed=float(np.mean([p.missed for p in parts])),
        false=float(np.mean([p.false for p in parts])),
        switches=continuity(rows, matches, matches.track, stretches).switches,
        milliseconds=cost,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the means over the runs."""
    parser = argparse.ArgumentParser(description='Two crossing manoeuvring aircraft in clutter.')
    parser.add_argument('--runs', type=int, default=100)
    parser.add_argument('--seed', type=int, default=1, help='of the first run')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args(arguments)
    values = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    config = with_values(RadarTrackerConfig(), {**PARAMETERS, **values})
    scenario = build('crossing')
    outcomes = [run(scenario, config, given.seed + k) for k in range(given.runs)]
    mean = {name: np.mean([getattr(o, name) for o in outcomes]) for name in vars(outcomes[0])}
    error = np.std([o.gospa for o in outcomes]) / np.sqrt(given.runs)
    print(f'GOSPA (c = 1 km, p = 2, alpha = 2)  {mean["gospa"]:.1f} +- {error:.1f} m')
    print(f'  localisation                      {mean["localisation"]:.1f} m (rms, both)')
    print(f'  missed, false                     {mean["missed"]:.3f}, {mean["false"]:.3f} a scan')
    print(f'id switches                         {mean["switches"]:.2f} a run')
    print(f'CPU                                 {mean["milliseconds"]:.2f} ms a scan')


if __name__ == '__main__':
    main()
