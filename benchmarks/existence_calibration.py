# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Is a track that is called 0.9 likely real in nine cases of ten?

Run ``python -m benchmarks.existence_calibration``. Contacts appear and vanish as the parameters
say, among false plots; every (track, scan) row is compared with what was really there.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Protocol

import numpy as np
from tqdm import tqdm

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Bools, Floats, Plots, Tracks
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

PERIOD = 4.0  # between looks [s]
NEAREST, FARTHEST = 2_000.0, 40_000.0  # [m]
VOLUME = (FARTHEST - NEAREST) * 2.0 * np.pi  # of plot space [m rad]
EDGES = np.array([0.0, 0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95, 0.99, 1.0])
CONFIG = with_values(
    RadarTrackerConfig(),
    {
        'sensor.range_sd': 30.0,
        'sensor.azimuth_sd': 0.002,
        'sensor.range_min': NEAREST,
        'sensor.range_max': FARTHEST,
        'motion.horizontal.acceleration_sd': [0.5, 5.0],
        'motion.horizontal.sojourn_time': [120.0, 30.0],
        'initiation.speed_max': 250.0,
        'existence.lifetime': 300.0,
    },
)


class Surroundings(Protocol):
    """What decides on the plots of one look."""

    @property
    def detection_probability(self) -> float:
        """Of each contact."""
        ...

    @property
    def false_plots(self) -> float:
        """How many are expected in one look."""
        ...


@dataclass(frozen=True)
class Case:
    """What the sensor lives among."""

    name: str
    detection_probability: float
    false_plots: float  # of one look
    births: float  # in one look
    is_told: bool  # the tracker knows the clutter density


CASES = (
    Case('default', 0.9, 20.0, 0.2, is_told=True),
    Case('density estimated', 0.9, 20.0, 0.2, is_told=False),
    Case('dense clutter', 0.9, 100.0, 0.2, is_told=True),
    Case('weak contacts', 0.6, 20.0, 0.2, is_told=True),
    Case('rare contacts', 0.9, 20.0, 0.02, is_told=True),
    Case('many contacts', 0.9, 20.0, 1.0, is_told=True),
)


@dataclass(frozen=True)
class Rows:
    """Every track at every look."""

    existence_probability: Floats  # (N,)
    real: Bools  # (N,) a contact was there

    def share(self, low: float, high: float) -> tuple[float, int]:
        """Return the share of real ones among rows called low to high likely, and their number."""
        inside = (self.existence_probability >= low) & (self.existence_probability <= high)
        return float(np.mean(self.real[inside])) if inside.any() else np.nan, int(inside.sum())


def make_config(case: Case) -> RadarTrackerConfig:
    """Return the parameters that are true for this case."""
    return with_values(
        CONFIG,
        {
            'sensor.detection_probability': case.detection_probability,
            'clutter_density': case.false_plots / VOLUME if case.is_told else 0.0,
            'existence.new_contacts': case.births * 3600.0 / PERIOD,
        },
    )


def play(case: Case, scenes: int, looks: int, seed: int, quiet: bool = True) -> Rows:
    """Track short scenes; return all rows but those of the first look."""
    existence, real = [], []
    rng = np.random.default_rng(seed)
    for _ in tqdm(range(scenes), desc=case.name, disable=quiet, leave=False):
        tracker, truth = RadarTracker(make_config(case)), np.zeros((0, 4))
        for k in range(looks):
            truth = _next_truth(truth, case, rng)
            tracks = tracker.track(look(truth, case, k * PERIOD, rng))
            existence.append(tracks.existence_probability)
            real.append(is_real(tracks, truth))
    return Rows(np.concatenate(existence), np.concatenate(real))


def is_real(tracks: Tracks, truth: Floats) -> Bools:
    """Return which tracks (T,) have a contact within 5 sigma of their position and velocity."""
    return np.asarray((distances(tracks, truth) < 25.0).any(axis=1))


def distances(tracks: Tracks, truth: Floats) -> Floats:
    """Return how far tracks are from contacts (N, 4), squared and normalised (T, N)."""
    mean, covariance = tracks.planes[0].moments()
    delta = mean[:, None] - truth
    scaled = np.linalg.solve(covariance[:, None], delta[..., None])[..., 0]
    return np.asarray((delta * scaled).sum(axis=2))


def _next_truth(truth: Floats, case: Case, rng: np.random.Generator) -> Floats:
    """Return the contacts (x, vx, y, vy) one look later: some vanish, some appear."""
    lives = rng.random(len(truth)) < np.exp(-PERIOD / CONFIG.existence.lifetime)
    truth = truth[lives].copy()
    push = 0.5 * rng.standard_normal((len(truth), 2))
    truth[:, 0::2] += PERIOD * truth[:, 1::2] + 0.5 * PERIOD**2 * push
    truth[:, 1::2] += PERIOD * push
    born = rng.poisson(case.births)
    distance, azimuth = rng.uniform(NEAREST, FARTHEST, born), rng.uniform(-np.pi, np.pi, born)
    speed = CONFIG.initiation.speed_max * np.sqrt(rng.random(born))  # even over the disc
    course = rng.uniform(-np.pi, np.pi, born)
    fresh = np.stack(
        [
            distance * np.cos(azimuth),
            speed * np.cos(course),
            distance * np.sin(azimuth),
            speed * np.sin(course),
        ],
        axis=1,
    )
    return np.concatenate([truth, fresh])


def look(truth: Floats, case: Surroundings, time: float, rng: np.random.Generator) -> Plots:
    """Return the plots of contacts (N, 4) that are detected, and false ones, in random order."""
    distance = np.hypot(truth[:, 0], truth[:, 2])
    inside = (distance > NEAREST) & (distance < FARTHEST)  # who has left is real, but not seen
    seen = truth[inside & (rng.random(len(truth)) < case.detection_probability)]
    false = rng.poisson(case.false_plots)
    count = len(seen) + false
    distance = np.hypot(seen[:, 0], seen[:, 2])
    distance = distance + CONFIG.sensor.range_sd * rng.standard_normal(len(seen))
    azimuth = np.arctan2(seen[:, 2], seen[:, 0])
    azimuth = azimuth + CONFIG.sensor.azimuth_sd * rng.standard_normal(len(seen))
    distance = np.concatenate([distance, rng.uniform(NEAREST, FARTHEST, false)])
    azimuth = np.concatenate([azimuth, rng.uniform(-np.pi, np.pi, false)])
    order = rng.permutation(count)
    plots = Plots.polar(np.full(count, time), distance[order], wrap_angle(azimuth[order]))
    return replace(plots, stamp=time)


def main() -> None:
    """Print a reliability table for every case."""
    parser = argparse.ArgumentParser(description='Is existence probability calibrated?')
    parser.add_argument('--scenes', type=int, default=60)
    parser.add_argument('--looks', type=int, default=40)
    arguments = parser.parse_args()
    for case in CASES:
        rows = play(case, arguments.scenes, arguments.looks, seed=1, quiet=False)
        share, count = rows.share(0.85, 0.95)
        print(f'{case.name}: called 0.85..0.95 likely {count} rows, real {share:.3f}')
        for low, high in pairwise(EDGES):
            share, count = rows.share(low, high)
            print(f'    {low:4.2f} .. {high:4.2f}  {count:7d} rows  real {share:.3f}')


if __name__ == '__main__':
    main()
