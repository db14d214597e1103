# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check how simulated contacts move: exact legs, splines, the published path."""

import math

import numpy as np
import pytest

from tracking_tools.scenarios import (
    Leg,
    Legs,
    Sampled,
)
from tracking_tools.scenarios.studies import z0_path

EVERYTHING = Legs(
    (1.0, -2.0, 3.0),
    speed=100.0,
    course=0.7,
    climb_rate=-1.0,
    start=5.0,
    legs=(
        Leg(10.0),
        Leg(20.0, turn_rate=0.05, acceleration=1.5, vertical_acceleration=0.3),
        Leg(30.0, turn_rate=1e-5, acceleration=-0.5),
        Leg(8.0, turn_rate=-0.02, climb_rate=4.0),
    ),
)


def test_legs_velocity_is_the_derivative_of_position():
    """Turns, accelerations and climbs agree with a central difference, also outside the legs."""
    time = np.setdiff1d(np.linspace(0.0, 90.0, 200), [5.0, 15.0, 35.0, 65.0, 73.0])
    step = 1e-4
    ahead, behind = EVERYTHING.at(time + step)[0], EVERYTHING.at(time - step)[0]
    np.testing.assert_allclose((ahead - behind) / (2.0 * step), EVERYTHING.at(time)[1], atol=1e-5)


def test_legs_position_has_no_jump_at_the_joints():
    """The end of a leg is the beginning of the next."""
    joints = np.array([5.0, 15.0, 35.0, 65.0, 73.0])
    before, after = EVERYTHING.at(joints - 1e-9)[0], EVERYTHING.at(joints)[0]
    np.testing.assert_allclose(before, after, atol=1e-6)


@pytest.mark.parametrize('angle', [1e-9, 1e-3, 0.2999, 0.3001, 1.0, 7.0])
def test_legs_turn_is_a_circle(angle):
    """At constant speed the chord of a turn is 2 r sin(angle / 2), at small and large angles."""
    path = Legs((0.0, 0.0, 0.0), 150.0, 0.4, (Leg(30.0, turn_rate=angle / 30.0),))
    position, velocity = path.at(30.0)
    chord = 2.0 * (150.0 * 30.0 / angle) * math.sin(angle / 2.0)
    assert math.hypot(*position[:2]) == pytest.approx(abs(chord), rel=1e-12)
    assert math.hypot(*velocity[:2]) == pytest.approx(150.0, rel=1e-12)


def test_z0_path_gives_the_published_measurements():
    """METHODS.md 1, golden values of run 0: path, noise stream and conversion, to 1 mm."""
    position, _ = z0_path().at(10.0 * np.arange(76))
    noise = np.random.default_rng(20090528).standard_normal((500, 76, 3))[0]
    x, y, z = position.T
    distance = np.linalg.norm(position, axis=1) + 300.0 * noise[:, 0]
    azimuth = np.arctan2(y, x) + math.radians(0.166) * noise[:, 1]
    elevation = np.arctan2(z, np.hypot(x, y)) + math.radians(0.166) * noise[:, 2]
    ground = distance * np.cos(elevation)
    measured = np.stack(
        [ground * np.cos(azimuth), ground * np.sin(azimuth), distance * np.sin(elevation)], axis=1
    )
    golden = {
        2: (167327.798, 133950.909, 8691.350),
        20: (98725.166, 79857.241, 9268.943),
        31: (136846.336, 43754.857, 1304.885),
    }
    for k, expected in golden.items():
        np.testing.assert_allclose(measured[k], expected, atol=1e-3)


def test_sampled_passes_its_samples_and_leaves_straight():
    """A spline through samples of a circle is a circle, and beyond the last goes straight on."""
    time = np.arange(0.0, 100.0, 2.0)
    circle = np.stack([np.cos(time / 20), np.sin(time / 20), 0.0 * time], axis=1) * 2_000.0
    path = Sampled(time, circle)
    np.testing.assert_allclose(path.at(time)[0], circle, atol=1e-9)
    between, velocity = path.at(np.linspace(10.0, 90.0, 77))
    np.testing.assert_allclose(np.hypot(*between[:, :2].T), 2_000.0, atol=0.02)
    np.testing.assert_allclose(np.hypot(*velocity[:, :2].T), 100.0, atol=0.02)
    (last, later), (speed, same) = path.at(np.array([98.0, 108.0]))
    np.testing.assert_allclose(later, last + 10.0 * speed, rtol=1e-12)
    np.testing.assert_array_equal(speed, same)
