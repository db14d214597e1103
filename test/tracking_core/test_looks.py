# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When the antenna passes a track, and what the sensor can see."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest
from scipy.spatial.transform import Rotation

from tracking_core.batches import Coverage, NO_SWING
from tracking_core.looks import (
    inside_coverage,
    LARGEST_MARGIN,
    longest_since,
    margins,
    may_be_passed_again,
    next_looks,
)  # fmt: skip

PERIOD = 4.0


def turn(start: float, sense: float, azimuth: float = 0.5 * np.pi) -> Coverage:
    """One full turn from an azimuth on."""
    return Coverage(start, start + PERIOD, azimuth, sense * 2.0 * np.pi)


@pytest.mark.parametrize('sense', [1.0, -1.0])
def test_next_looks_meet_the_antenna(sense: float) -> None:
    """
    At the time found, the antenna points where the moving track then is.

    To what the track's direction may change in a turn, which a plot's own time makes good.
    """
    rng = np.random.default_rng(1)
    position = rng.normal(0.0, 2e4, (300, 2))
    velocity = rng.normal(0.0, 100.0, (300, 2))
    coverage = turn(100.0, sense)
    looks = next_looks(position, velocity, np.full(300, 96.5), coverage)
    away = position + velocity * (looks.time - 96.5)[:, None]
    antenna = coverage.start_azimuth + coverage.rotation_rate * (looks.time - 100.0)
    off = np.angle(np.exp(1j * (np.arctan2(away[:, 1], away[:, 0]) - antenna)))
    distance = np.minimum(np.linalg.norm(away, axis=1), np.linalg.norm(position, axis=1))
    change = np.linalg.norm(velocity, axis=1) * PERIOD / distance
    assert (np.abs(off[change < 0.1]) < 1.5 * change[change < 0.1]).all()
    assert np.median(np.abs(off)) < 2e-3
    assert (looks.time >= 96.5 + 0.5 * PERIOD - 1e-6).all()
    assert (looks.time < 100.0 + PERIOD).all()


@pytest.mark.parametrize('sense', [1.0, -1.0])
def test_next_looks_meet_an_antenna_that_moves_and_swings(sense: float) -> None:
    """At the time found it points from where it then is; at 60 m/s that is 120 m at the ends."""
    rng = np.random.default_rng(1)
    position, velocity = rng.normal(0.0, 3e3, (300, 2)), rng.normal(0.0, 10.0, (300, 2))
    swing = 0.1 * np.sin(np.linspace(0.0, 2.0 * np.pi, len(NO_SWING)))
    coverage = replace(
        turn(100.0, sense), sensor_position=(500.0, 200.0, 0.0), sensor_velocity=(60.0, 0.0, 0.0),
        swing=tuple(swing.tolist()),
    )  # fmt: skip
    time = next_looks(position, velocity, np.full(300, 96.5), coverage).time
    sensor = np.array([500.0, 200.0]) + np.outer(time - 102.0, [60.0, 0.0])
    away = position + velocity * (time - 96.5)[:, None] - sensor
    off = np.angle(np.exp(1j * (np.arctan2(away[:, 1], away[:, 0]) - coverage.azimuth_at(time))))
    inside = (time > 100.0) & (np.hypot(*away.T) > 1e3)
    assert inside.sum() > 150
    assert np.abs(off[inside]).max() < 5e-3  # 0.08 from where it is at the end


def test_margins_are_wider_for_what_is_high_where_the_antenna_leans() -> None:
    """Oracle: how far a direction at 45 degrees turns about a deck that leans by 5 degrees."""
    lean = np.radians(5.0)
    upright = turn(0.0, 1.0)
    place, size = np.array([[3e3, 0.0, 3e3], [0.0, 3e3, 0.0]]), np.full(2, 30.0)
    usual = margins(place, size, upright)
    wide = margins(place, size, replace(upright, tilt=lean))
    about = Rotation.from_euler('x', lean).apply(place[0])
    turned = np.arctan2(about[1], about[0]) / (2.0 * np.pi) * PERIOD
    assert_allclose(wide - usual, [abs(turned), 0.0], rtol=0.01)


@pytest.mark.parametrize('sense', [1.0, -1.0])
def test_next_looks_come_once_a_turn(sense: float) -> None:
    """A standing track near the cut of the messages is passed every 4 s, never skipped."""
    for offset in (-0.01, 0.0, 0.01):
        azimuth = 0.5 * np.pi + offset
        position = 1e4 * np.array([[np.cos(azimuth), np.sin(azimuth)]])
        time, passes = np.array([-3.9]), []
        for k in range(20):
            for _ in range(2):
                looks = next_looks(position, np.zeros((1, 2)), time, turn(k * PERIOD, sense))
                if looks.near[0] and looks.time[0] <= (k + 1) * PERIOD:
                    time = looks.time
                    passes.append(time[0])
        assert len(passes) >= 19
        assert_allclose(np.diff(passes), PERIOD, atol=1e-9)


@pytest.mark.parametrize('sense', [1.0, -1.0])
@pytest.mark.parametrize(
    ('gaps', 'watched'),
    [
        ([], [(98.5, 100.4)]),
        ([(90.0, 94.0)], [(98.5, 100.4)]),
        ([(99.0, 100.0)], [(97.5, 99.0), (100.0, 100.4)]),
        ([(98.0, 98.5), (99.0, 100.0)], [(97.0, 98.0), (98.5, 99.0), (100.0, 100.4)]),
        ([(-np.inf, 100.0)], [(100.0, 100.4)]),
    ],
)
def test_next_looks_see_nothing_of_a_gap(
    sense: float, gaps: list[tuple[float, float]], watched: list[tuple[float, float]]
) -> None:
    """Of contacts all around: those passed in the last 3/8 of a turn that was no gap, and now."""
    azimuth = 2.0 * np.pi * (np.arange(80) + 0.5) / 80.0
    position = 1e4 * np.column_stack([np.cos(azimuth), np.sin(azimuth)])
    sweep = sense * 0.2 * np.pi
    coverage = Coverage(100.0, 100.4, 0.0, sweep, tuple(gaps))
    looks = next_looks(position, np.zeros((80, 2)), np.full(80, 95.0), coverage)
    passed = looks.time[looks.time <= coverage.end_time]
    inside = [(passed >= begin) & (passed <= end) for begin, end in watched]
    assert len(passed) == np.sum(inside) == round(sum(20.0 * (e - b) for b, e in watched))


@pytest.mark.parametrize('sense', [1.0, -1.0])
@pytest.mark.parametrize('turns', [0.9, 1.0, 1.4])
@pytest.mark.parametrize('speed', [5.0, 300.0])
def test_tracks_that_may_be_passed_again_are_few_and_all(
    sense: float, turns: float, speed: float
) -> None:
    """Each whose next look has begun is among them; of slow ones nearly no other in a turn."""
    rng = np.random.default_rng(2)
    swing = 0.1 * np.sin(np.linspace(0.0, 2.0 * np.pi, len(NO_SWING)))
    coverage = Coverage(
        100.0, 100.0 + turns * PERIOD, 1.0, sense * turns * 2.0 * np.pi, unevenness=0.02,
        sensor_velocity=(10.0, 5.0, 0.0), swing=tuple(swing.tolist()),
    )  # fmt: skip
    time = rng.uniform(100.0, coverage.end_time, 2000)
    distance, size = rng.uniform(100.0, 2e4, 2000), rng.uniform(0.0, 500.0, 2000)
    azimuth = coverage.azimuth_at(time) + rng.uniform(-1.0, 1.0, 2000) * size / distance
    where = np.stack([distance * np.cos(azimuth), distance * np.sin(azimuth)], axis=1)
    motion = where + coverage.sensor_at(time)[:, :2], rng.normal(0.0, speed, (2000, 2)), time
    looks = next_looks(*motion, coverage)
    begun = looks.time - margins(motion[0], size, coverage) <= coverage.end_time
    may = may_be_passed_again(*motion, size, coverage)
    assert not (begun & ~may).any()
    assert begun.any()
    assert may.mean() < begun.mean() + 0.35


def test_next_looks_of_a_staring_sensor_are_in_the_middle() -> None:
    """A sensor that looks everywhere at once looks at every track."""
    looks = next_looks(np.zeros((2, 2)), np.zeros((2, 2)), np.zeros(2), Coverage(1.0, 3.0))
    assert_allclose(looks.time, 2.0)
    assert looks.near.all()


def test_margins_are_the_angle_of_the_gate() -> None:
    """Half size over distance, a turn in 4 s; bounded for gates about the sensor."""
    far, about = np.array([1000.0, 0.0]), np.array([1.0, 0.0])
    margin = margins(np.stack([far, about]), np.array([1000.0, 1000.0]), turn(0.0, 1.0))
    assert_allclose(margin, [PERIOD / 8.0, LARGEST_MARGIN * PERIOD])
    assert_array_equal(margins(far[None], np.ones(1), Coverage(0.0, 1.0)), [0.0])


def test_inside_coverage_knows_range_and_sector() -> None:
    """Range limits and a sector across the cut of the angles."""
    coverage = replace(
        Coverage(0.0, 1.0), sensor_position=(100.0, 0.0, 0.0), range_min=50.0, range_max=500.0,
        sector_centre=np.pi, sector_width=1.0,
    )  # fmt: skip
    position = np.array(
        [[-200.0, 10.0], [-200.0, -10.0], [60.0, 0.0], [-500.0, 0.0], [300.0, 0.0]]
    )
    assert_array_equal(inside_coverage(position, coverage), [True, True, False, False, False])
    high = np.array([[-200.0, 10.0, 450.0], [-200.0, 10.0, 100.0]])
    assert_array_equal(inside_coverage(high, coverage), [False, True])


@pytest.mark.parametrize('sense', [1.0, -1.0])
def test_longest_since_is_in_whole_turns(sense: float) -> None:
    """Of plots that are nearly two turns old, others at their place come after one turn."""
    earlier = np.array([96.1, 98.0, 99.9, 92.1, 104.0])
    longest = longest_since(earlier, 103.9, turn(100.0, sense))
    margin = LARGEST_MARGIN * PERIOD
    assert_allclose(longest, [7.8, PERIOD + margin, 4.0, 2.0 * PERIOD + 3.8, 0.0])
    assert_allclose(longest_since(earlier, 103.9, Coverage(100.0, 103.9))[:2], [7.8, 5.9])
