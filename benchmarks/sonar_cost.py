# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a sonar cycle cost? CPU milliseconds with a hundred contacts all around.

Run ``python -m benchmarks.sonar_cost``; ``scan_cost`` prints the same. Contacts nearer to each
other than the resolution give one mark between them, and 50 marks a cycle are false. Median over
the cycles after warming up.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

CONTACTS, FALSE = 100, 50
NOISE, RESOLUTION = 0.003, 0.02  # [rad]
RATE = 2e-4  # sd of the contacts' bearing rates [rad/s]
DETECTION = 0.9
LIMIT = 5.0  # [ms]
_WARM_UP, _MEASURED = 40, 60  # cycles of a second

PARAMETERS: dict[str, Any] = {
    'sensor.array': 'omnidirectional',
    'sensor.bearing_sd': NOISE,
    'sensor.detection_probability': DETECTION,
    'clutter_density': FALSE / (2.0 * np.pi),
}


@dataclass(frozen=True)
class CycleCost:
    """Medians over the measured cycles."""

    tracks: float
    confirmed: float
    marks: float
    total: float  # CPU of a cycle [ms]


def cycles(count: int, seed: int = 1) -> Iterator[Bearings]:
    """Yield the marks of each cycle."""
    rng = np.random.default_rng(seed)
    start, rate = rng.uniform(-np.pi, np.pi, CONTACTS), RATE * rng.standard_normal(CONTACTS)
    for time in range(count):
        seen = np.sort(wrap_angle(start + rate * time)[rng.random(CONTACTS) < DETECTION])
        merged = np.concatenate([[0], np.cumsum(np.diff(seen) > RESOLUTION)])
        mean = np.bincount(merged, seen) / np.bincount(merged)
        marks = np.concatenate([
            mean + NOISE * rng.standard_normal(len(mean)),
            rng.uniform(-np.pi, np.pi, rng.poisson(FALSE)),
        ])  # fmt: skip
        yield Bearings.of(np.full(len(marks), float(time)), wrap_angle(marks))


def cycle_cost(resolution: float) -> CycleCost:
    """Return what a cycle costs with this resolution limit [rad], 0: off."""
    values = {**PARAMETERS, 'sensor.bearing_resolution': resolution}
    tracker, samples = SonarTracker(with_values(SonarTrackerConfig(), values)), []
    for cycle, marks in enumerate(cycles(_WARM_UP + _MEASURED)):
        begin = process_time()
        tracks = tracker.track(marks)
        spent = process_time() - begin
        if cycle >= _WARM_UP:
            samples.append([len(tracks), tracks.confirmed.sum(), len(marks), 1e3 * spent])
    return CycleCost(*np.median(samples, axis=0))


def lines() -> Iterator[str]:
    """Yield the costs with and without unresolved marks, and the verdict."""
    yield f'{"sonar cycle":22}{"tracks":>8}{"confirmed":>10}{"marks":>8}{"total":>9}'
    for name, resolution in (('resolution on', RESOLUTION), ('resolution off', 0.0)):
        c = cycle_cost(resolution)
        verdict = 'good' if c.total <= LIMIT else 'ABOVE THE LIMIT'
        yield f'{name:22}{c.tracks:8.0f}{c.confirmed:10.0f}{c.marks:8.0f}{c.total:9.2f}  {verdict}'


def main() -> None:
    """Print the costs of a cycle."""
    for line in lines():
        print(line)


if __name__ == '__main__':
    main()
