# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does a contact manoeuvre in nine of ten cases where its manoeuvre probability is 0.9?

Run ``python -m benchmarks.manoeuvre_calibration``. Contacts jump between the modes of the tracker
just as its parameters say; every confirmed track at every look is compared with the mode in which
its contact has moved since the look before.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from tqdm import tqdm

from benchmarks.existence_calibration import CONFIG, distances, FARTHEST, look, PERIOD, VOLUME
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.planes import build_planes
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Bools, Floats, Ints, Tracks
from tracking_core.config import with_values
from tracking_core.estimators import MarkovJump

EDGES = np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 1.0])
CONTACTS, SPEED = 20, 150.0  # in one scene, [m/s]
SETTLED = 10  # looks until all contacts have tracks
NEAR = 40.0  # normalised squared distance (four degrees of freedom) of a track and its contact
RATE = 0.05  # of turns [rad/s]


@dataclass(frozen=True)
class Case:
    """How contacts move, and among what."""

    name: str
    motion: Mapping[str, tuple[float, ...]] = field(default_factory=dict)  # of the plane
    detection_probability: float = 0.9
    false_plots: float = 20.0  # of one look

    @property
    def config(self) -> RadarTrackerConfig:
        """Parameters that are true."""
        motion = {f'motion.horizontal.{name}': value for name, value in self.motion.items()}
        return with_values(
            CONFIG,
            {
                **motion,
                'sensor.detection_probability': self.detection_probability,
                'clutter_density': self.false_plots / VOLUME,
            },
        )


CASES = (
    Case('default'),
    Case('a loud second mode', {'acceleration_sd': (0.2, 10.0)}),
    Case('modes that are much alike', {'acceleration_sd': (1.0, 4.0)}),
    Case(
        'turns to both sides',
        {
            'acceleration_sd': (0.5, 0.5, 0.5),
            'sojourn_time': (120.0, 30.0, 30.0),
            'turn_rate': (0.0, RATE, -RATE),
        },
    ),
    Case('weak contacts', detection_probability=0.6),
    Case('dense clutter', false_plots=100.0),
    Case('neither misses nor clutter', detection_probability=0.999, false_plots=1e-3),
)


@dataclass(frozen=True)
class Rows:
    """Every confirmed track at every look."""

    told: Floats  # (N,) manoeuvre probability
    real: Bools  # (N,) the contact was in another mode than the quiet one

    def between(self, low: float, high: float) -> tuple[float, float, int]:
        """Return the mean told, the share real and the number of rows told low to high."""
        inside = (self.told >= low) & (self.told <= high)
        if not inside.any():
            return np.nan, np.nan, 0
        return self.told[inside].mean(), float(self.real[inside].mean()), int(inside.sum())


def play(case: Case, scenes: int, looks: int, seed: int, quiet: bool = True) -> Rows:
    """Track scenes of contacts that are there from beginning to end."""
    told, real, rng = [], [], np.random.default_rng(seed)
    motion = build_planes(case.config, 2)[0].estimator
    assert isinstance(motion, MarkovJump)
    for _ in tqdm(range(scenes), desc=case.name, disable=quiet, leave=False):
        tracker, truth, mode = RadarTracker(case.config), _contacts(rng), np.zeros(CONTACTS, int)
        for k in range(looks):
            truth, mode = _moved(truth, mode, motion, rng)
            tracks = tracker.track(look(truth, case, k * PERIOD, rng))
            if k >= SETTLED:
                of, contact = _pairs(tracks, truth)
                told.append(1.0 - tracks.planes[0].mode_probability[of, 0])
                real.append(mode[contact] > 0)
    return Rows(np.concatenate(told), np.concatenate(real))


def _contacts(rng: np.random.Generator) -> Floats:
    """Return states (CONTACTS, 4) half-way out, so that few leave."""
    azimuth, course = rng.uniform(-np.pi, np.pi, (2, CONTACTS))
    distance = FARTHEST * rng.uniform(0.3, 0.7, CONTACTS)
    place, velocity = distance * np.exp(1j * azimuth), SPEED * np.exp(1j * course)
    return np.stack([place.real, velocity.real, place.imag, velocity.imag], axis=1)


def _moved(
    truth: Floats, mode: Ints, motion: MarkovJump, rng: np.random.Generator
) -> tuple[Floats, Ints]:
    """Return states and modes one look later: a new mode first, then the motion of that mode."""
    dt = np.array([PERIOD])
    reached = motion.chain.transition_probability(dt)[0].cumsum(axis=1)[mode]
    mode = (rng.random(len(mode))[:, None] > reached[:, :-1]).sum(axis=1)
    truth = truth.copy()
    for number, one in enumerate(motion.motions):
        own, Q = mode == number, one.process_noise(dt)[0]
        push = rng.multivariate_normal(np.zeros(4), Q, own.sum(), method='eigh')
        truth[own] = truth[own] @ one.transition(dt)[0].T + push
    return truth, mode


def _pairs(tracks: Tracks, truth: Floats) -> tuple[Ints, Ints]:
    """Return the confirmed tracks that follow a contact, and the contact of each."""
    distance = distances(tracks, truth)
    of = np.flatnonzero(tracks.confirmed & (distance.min(axis=1, initial=np.inf) < NEAR))
    return of, distance[of].argmin(axis=1)


def main() -> None:
    """Print a reliability table for every case."""
    parser = argparse.ArgumentParser(description='Is manoeuvre probability calibrated?')
    parser.add_argument('--scenes', type=int, default=12)
    parser.add_argument('--looks', type=int, default=100)
    arguments = parser.parse_args()
    for case in CASES:
        rows = play(case, arguments.scenes, arguments.looks, seed=1, quiet=False)
        print(f'{case.name}: {len(rows.told)} rows, {rows.told.mean():.3f} told, '
              f'{rows.real.mean():.3f} real')  # fmt: skip
        for low, high in pairwise(EDGES):
            told, real, n = rows.between(low, high)
            print(f'    {low:4.2f} .. {high:4.2f}  {n:7d} rows  told {told:.3f}  real {real:.3f}')


if __name__ == '__main__':
    main()
