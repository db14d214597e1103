# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How long is it from look to look? Not as long as from one last plot to another."""

from __future__ import annotations

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings, Coverage
from tracking_core.config import with_values
from tracking_core.interval import add_step, interval_of_looks, time_of_looks, time_of_turns

CYCLE = 10.0  # [s]


def usual(*scans: tuple[float, float]) -> float:
    """Return the interval after scans with a first and a last plot at these times."""
    steps, last = np.zeros(0), -np.inf
    for _, end in scans:
        steps = add_step(steps, end - last)
        last = max(end, last)
    return interval_of_looks(steps, Coverage(*scans[-1]))


def cycles(*numbers: float) -> list[tuple[float, float]]:
    """Return scans that look everywhere at once."""
    return [(CYCLE * number, CYCLE * number) for number in numbers]


def test_interval_of_even_scans_is_the_time_between_them() -> None:
    """From the second one on; of one alone nothing is known but how long it took."""
    assert usual(*cycles(7)) == 1.0
    assert usual((70.0, 78.0)) == 8.0
    assert usual(*cycles(7, 8)) == usual(*cycles(*range(30))) == CYCLE


@pytest.mark.parametrize(
    'odd', [[6.0], [5.0, 4.95, 6.0], [30.0, 31.0], [5.0 + 1e-6, 6.0], [500.0, 499.0]]
)
def test_interval_does_not_mind_odd_scans(odd: list[float]) -> None:
    """Lost and doubled messages, stamps that are equal or go back a little, pauses."""
    assert usual(*cycles(*range(6), *odd)) == CYCLE


def test_interval_follows_another_cycle() -> None:
    """After six scans of it, whether it is longer or shorter."""
    for cycle in (1.0, 45.0):
        later = 100.0 + cycle * np.arange(1, 7)
        assert usual(*cycles(*range(11)), *zip(later, later, strict=True)) == cycle


def test_interval_of_scans_that_end_with_their_last_plot() -> None:
    """One or two plots, or none, anywhere in the cycle: about the cycle, never a part of it."""
    rng, scans = np.random.default_rng(5), []
    for cycle in range(300):
        times = CYCLE * (cycle + rng.random(rng.integers(0, 3)))
        scans.append((times.min(initial=CYCLE * cycle + CYCLE), times.max(initial=CYCLE * cycle)))
        if len(times) == 0:
            scans[-1] = (CYCLE * cycle, CYCLE * cycle)
    found = np.array([usual(*scans[:count]) for count in range(9, 300)])
    assert 0.9 * CYCLE < np.median(found) < 1.2 * CYCLE
    assert found.min() > 0.5 * CYCLE
    assert found.max() < 1.5 * CYCLE


def test_interval_of_a_rotating_antenna_is_its_turn() -> None:
    """Whatever the messages are."""
    quarter = Coverage(3.0, 4.0, sweep=-0.5 * np.pi)
    assert interval_of_looks(np.array([1.0, 1.0]), quarter) == pytest.approx(4.0)


def test_time_of_looks_is_that_of_the_last_steps_or_turns() -> None:
    """However uneven the steps are; of fewer than asked for, all plots are."""
    steps, still, half = (
        np.array([9.0, 20.0, 3.0]),
        Coverage(0.0, 0.0),
        Coverage(0.0, 2.0, 0.0, np.pi),
    )
    assert time_of_looks(2, steps, still) == pytest.approx(23.0, rel=1e-3)
    assert time_of_looks(2, steps, still) < 23.0
    assert time_of_looks(4, steps, still) == np.inf
    assert time_of_looks(2, steps, half) == pytest.approx(2.5 * 4.0)
    assert time_of_turns(2, still) == np.inf


@pytest.mark.parametrize(
    ('silent', 'other'), [(0, 0.0), (0, 0.5), (0, 9.5), (5, 0.5), (5, 5.0), (5, 9.5)]
)
def test_first_mark_waits_whenever_the_last_of_its_cycle_came(silent: int, other: float) -> None:
    """A contact that is not heard in the cycle between is one, wherever the other mark was."""
    values = {'sensor.bearing_sd': 0.01, 'clutter_density': 1e-3}
    sonar = SonarTracker(with_values(SonarTrackerConfig(), values))
    heard = [*silent * [[]], [(0.0, 0.3), (other, 2.0)], [], [(0.0, 0.3)]]
    for cycle, marks in enumerate(heard):
        time, bearing = np.array(marks).reshape(-1, 2).T
        sonar.track(Bearings.of(CYCLE * cycle + time, bearing, stamp=CYCLE * cycle))
    assert len(sonar.tracks) == 1


def test_steps_are_kept_and_few() -> None:
    """They are a part of what a tracker remembers, and do not grow with it."""
    sonar = SonarTracker(SonarTrackerConfig())
    for stamp in CYCLE * np.arange(40):
        sonar.track(Bearings.of(np.zeros(0), np.zeros(0), stamp=stamp))
    assert sonar.state.steps.tolist() == 11 * [CYCLE]
