# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What plots measure of a plane: position at their own time, range rate, parts that are absent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from tracking_core import measurement
from tracking_core.batches import (
    Coverage,
    Floats,
    Innovations,
    Measurement,
    Mixture,
    Pairs,
    Scan,
)
from tracking_core.kalman import innovate

SENSOR = np.array([100.0, 0.0, 0.0])  # [m]


def make_scan(position, range_rate=None, variance=4.0) -> Scan:
    """Make plots at these positions with correlated noise, seen from a moving platform."""
    position = np.asarray(position, float)
    M, d = position.shape
    return Scan(
        time=np.zeros(M),
        position=position,
        covariance=np.tile(100.0 * (np.eye(d) + 0.5), (M, 1, 1)),
        range_rate=np.full(M, np.nan) if range_rate is None else np.asarray(range_rate, float),
        range_rate_variance=np.full(M, variance),
        snr=np.full(M, np.nan),
        clutter_volume=np.ones(M),
        sensor_position=np.tile(SENSOR, (M, 1)),
        sensor_velocity=np.tile([0.0, 5.0, 0.0], (M, 1)),
        coverage=Coverage(0.0, 1.0),
        volume=1.0,
    )


def test_of_plane_measures_at_the_time_of_the_plot() -> None:
    """H moves the track over the lag."""
    scan = make_scan([[1000.0, 2000.0, 300.0]])
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.array([0.5]))
    level = measurement.of_plane((0, 1), pairs, scan, scan.position[pairs.plot])
    assert_allclose(level.matrix[0], [[1.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.5]])
    assert_allclose(level.value[0], [1000.0, 2000.0])
    assert_allclose(level.covariance[0], [[150.0, 50.0], [50.0, 150.0]])
    height = measurement.of_plane((2,), pairs, scan, scan.position[pairs.plot])
    assert_allclose(height.matrix[0], [[1.0, 0.5]])
    assert_allclose(height.value[0], [300.0])
    assert_array_equal(height.absent, [0])


def test_of_plane_leaves_out_what_is_not_measured() -> None:
    """A plot without height tells nothing of the vertical plane: likelihood 1, no change."""
    scan = make_scan([[1000.0, 2000.0, np.nan]])
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1))
    height = measurement.of_plane((2,), pairs, scan, scan.position[pairs.plot])
    assert_array_equal(height.absent, [1])
    plane = Mixture(np.ones((1, 1, 2)), np.eye(2)[None, None], np.ones((1, 1)), np.zeros((1, 0)))
    result = innovate(plane, pairs.track, height)
    assert_allclose(result.log_likelihood, 0.0)
    assert_allclose(result.distance, 0.0)
    assert_allclose(result.cross_covariance, 0.0)


def test_with_range_rate_measures_along_the_line_of_sight() -> None:
    """U (v - v_sensor), the velocity outside the plane as predicted."""
    velocity = np.array([[30.0, -40.0, 6.0]])
    offset = np.array([600.0, 800.0, 240.0])  # from the sensor
    sight = offset / np.linalg.norm(offset)
    range_rate = sight @ (velocity[0] - [0.0, 5.0, 0.0])
    scan = make_scan([offset + SENSOR], [range_rate])
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1))
    level = measurement.of_plane((0, 1), pairs, scan, scan.position[pairs.plot])
    full = measurement.with_range_rate(
        level, (0, 1), pairs, scan, scan.position, velocity, np.diag([9.0, 9.0, 2.0])[None]
    )
    state = np.array([700.0, 30.0, 800.0, -40.0])
    assert_allclose(full.matrix[0] @ state, full.value[0], rtol=1e-12)
    noise = scan.covariance[0]
    expected = 4.0 + 2.0 * sight[2] ** 2
    relative = velocity[0] - [0.0, 5.0, 0.0]
    slope = [
        (relative @ (offset + step) / np.linalg.norm(offset + step) - relative @ sight) / 1e-4
        for step in 1e-4 * np.eye(3)
    ]
    expected += slope @ noise @ slope
    assert_allclose(full.covariance[0, 2], [0.0, 0.0, expected], rtol=1e-6)


def test_with_range_rate_ignores_plots_without() -> None:
    """A NaN row leaves position and likelihood as they were."""
    scan = make_scan([[700.0, 800.0], [700.0, 800.0]], [np.nan, -10.0])
    pairs = Pairs(np.array([0, 0]), np.array([0, 1]), np.zeros(2))
    level = measurement.of_plane((0, 1), pairs, scan, scan.position[pairs.plot])
    full = measurement.with_range_rate(
        level, (0, 1), pairs, scan, scan.position, np.full((2, 2), 10.0),
        np.tile(np.eye(2), (2, 1, 1)),
    )  # fmt: skip
    assert_array_equal(full.absent, [1, 0])
    plane = Mixture(
        np.array([[[690.0, 10.0, 805.0, 10.0]]]), 50.0 * np.eye(4)[None, None], np.ones((1, 1)),
        np.zeros((1, 0)),
    )  # fmt: skip
    plain, with_rate = (innovate(plane, pairs.track, item) for item in (level, full))
    assert_allclose(with_rate.log_likelihood[0], plain.log_likelihood[0], rtol=1e-12)
    assert_allclose(with_rate.distance[0], plain.distance[0], rtol=1e-12)
    assert with_rate.distance[1, 0] > plain.distance[1, 0]


def folded(velocity_variance: float, interval: float) -> tuple[Innovations, Innovations]:
    """Return innovations of a position, and of the same with range rate -30 told as 10."""
    scan = replace(make_scan([[1100.0, 0.0]], [10.0]), range_rate_interval=interval)
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1))
    level = measurement.of_plane((0, 1), pairs, scan, scan.position[pairs.plot])
    covariance = velocity_variance * np.eye(2)[None]
    full = measurement.with_range_rate(
        level, (0, 1), pairs, scan, scan.position, np.array([[-29.0, 5.0]]), covariance
    )
    P = np.diag([50.0, velocity_variance, 50.0, velocity_variance])
    mean = np.array([[[1100.0, -29.0, 0.0, 5.0]]])
    plane = Mixture(mean, P[None, None], np.ones((1, 1)), np.zeros((1, 0)))
    position, both = (innovate(plane, pairs.track, item) for item in (level, full))
    return position, both


def test_ambiguous_range_rate_is_the_one_nearest_to_the_expected_one() -> None:
    """10 m/s, which comes again after 40, is -30 to a contact that comes at 29; else it is 10."""
    assert_allclose(folded(1.0, 40.0)[1].innovation[0, 0, 2], -1.0)
    assert_allclose(folded(1.0, 0.0)[1].innovation[0, 0, 2], 39.0)


def test_ambiguous_range_rate_says_nothing_of_a_vague_velocity() -> None:
    """Of 20 m/s sd nobody knows which it is: one in the interval, as evenly as of false plots."""
    position, both = folded(400.0, 40.0)
    assert_allclose(both.cross_covariance[0, 0, :, 2], 0.0)
    assert_allclose(both.distance, position.distance, atol=1e-12)
    assert_allclose(both.log_likelihood, position.log_likelihood - np.log(40.0), rtol=1e-12)


def test_ambiguous_range_rate_of_a_vague_velocity_is_no_component() -> None:
    """The gate asks how many components a plot has: the two of its position."""
    vague, told = (folding(variance * np.eye(2)[None], 0.0) for variance in (400.0, 1.0))
    assert_array_equal([vague.absent, told.absent], [[1], [0]])
    unknown = folding(400.0 * np.eye(2)[None], 0.0, np.nan)
    assert_array_equal(unknown.absent, [1])


def folding(covariance: Floats, bearing: float, rate: float = 10.0) -> Measurement:
    """Return what a plot with a range rate in 40 m/s measures of a track of this velocity P."""
    place = SENSOR[:2] + 1000.0 * np.array([np.cos(bearing), np.sin(bearing)])
    scan = replace(make_scan([place], [rate], variance=0.0), range_rate_interval=40.0)
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1))
    level = measurement.of_plane((0, 1), pairs, scan, scan.position[pairs.plot])
    velocity = scan.sensor_velocity[:, :2]
    return measurement.with_range_rate(
        level, (0, 1), pairs, scan, scan.position, velocity, covariance
    )


@pytest.mark.parametrize(('bearing', 'is_sure'), [(0.25, False), (-0.25, True)])
def test_ambiguous_range_rate_is_doubted_along_the_line_of_sight(bearing, is_sure) -> None:
    """Sd 10 m/s would fit into half of 40; it is 1.9 or 0.1 times the variance where it counts."""
    covariance = 0.95 * 100.0 * np.array([[[1.0, 0.9], [0.9, 1.0]]])
    found = folding(covariance, bearing * np.pi)
    assert bool(found.matrix[0, 2].any()) == is_sure


def test_with_range_rate_takes_the_velocities_of_other_planes_together() -> None:
    """Of the axis x alone, y and z are as predicted; what they have in common counts."""
    scan = make_scan([[700.0, 800.0, 300.0]], [1.0])
    scan = replace(scan, covariance=np.zeros((1, 3, 3)))
    pairs = Pairs(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1))
    level = measurement.of_plane((0,), pairs, scan, scan.position[pairs.plot])
    covariance = np.array([[[7.0, 0.0, 0.0], [0.0, 4.0, 1.0], [0.0, 1.0, 2.0]]])
    full = measurement.with_range_rate(
        level, (0,), pairs, scan, scan.position, np.zeros((1, 3)), covariance
    )
    line = scan.position[0] - SENSOR
    y, z = line[1:] / np.linalg.norm(line)
    expected = 4.0 + 4.0 * y**2 + 2.0 * z**2 + 2.0 * y * z
    assert_allclose(full.covariance[0, 1, 1], expected)
