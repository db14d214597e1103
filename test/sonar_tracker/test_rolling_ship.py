# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A sonar on a ship that rolls and pitches."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest
from scipy.spatial.transform import Rotation

from sonar_tracker.sensor import Sonar
from sonar_tracker.sensor_config import MountConfig, SensorConfig
from tracking_core.batches import Bearings, Coverage
from tracking_core.linalg import wrap_angle
from tracking_core.platform_pose import PlatformPose

TRUE = np.radians([5.0, 37.0, 90.0, 151.0, -120.0, -45.0])
ARRAYS = ('omnidirectional', 'linear')


def rolling(seed: int) -> Rotation:
    """Return a ship's attitudes, rolling and pitching by up to 15 degrees."""
    M, rng = len(TRUE), np.random.default_rng(seed)
    angles = np.stack([rng.uniform(-3.0, 3.0, M), *rng.uniform(-0.26, 0.26, (2, M))], axis=1)
    return Rotation.from_euler('ZYX', angles)


def pose_of(attitude: Rotation) -> PlatformPose:
    """Return own ship with these attitudes."""
    M = len(attitude)
    return PlatformPose(
        np.zeros((M, 3)), attitude.as_quat(), np.zeros((M, 3)), np.zeros((M, 3, 3)), np.zeros(M),
        np.zeros((M, 3)),
    )  # fmt: skip


def measured(marks, attitude: Rotation, array: str, yaw: float):
    """Return the bearings (M,) that the sonar makes of marks."""
    sonar = Sonar(SensorConfig(array=array, mount=MountConfig(yaw=yaw)))
    scan = sonar.measure(marks, pose_of(attitude), Coverage(0.0, 0.0))
    return scan.position[:, 0]


def heard(attitude: Rotation, array: str, yaw: float):
    """Return what an array that is turned by `yaw` on the deck measures of the horizon (M,)."""
    ray = np.stack([np.cos(TRUE), np.sin(TRUE), np.zeros_like(TRUE)], axis=1)
    on_deck = attitude * Rotation.from_euler('z', yaw)
    x, y, _ = on_deck.inv().apply(ray).T
    if array == 'omnidirectional':
        return np.arctan2(y, x)
    ahead = on_deck.apply([1.0, 0.0, 0.0])  # by the cone; the side is that of the axis
    side = np.sign(ahead[:, 0] * ray[:, 1] - ahead[:, 1] * ray[:, 0])
    return side * np.arccos(x)


@pytest.mark.parametrize('array', ['omnidirectional', 'linear'])
@pytest.mark.parametrize('yaw', [0.0, 0.4])
@pytest.mark.parametrize('seed', range(5))
def test_bearings_from_a_rolling_deck_are_those_on_the_horizon(array, yaw, seed) -> None:
    """Measured in the plane of the deck, by a linear array on a cone about its axis."""
    attitude = rolling(seed)
    marks = Bearings.of(np.zeros(len(TRUE)), heard(attitude, array, yaw))
    assert_allclose(wrap_angle(measured(marks, attitude, array, yaw) - TRUE), 0.0, atol=1e-7)


@pytest.mark.parametrize('array', ['omnidirectional', 'linear'])
@pytest.mark.parametrize('yaw', [0.0, 0.4])
def test_true_bearings_stay_true_on_a_rolling_deck(array, yaw) -> None:
    """Own ship's attitude is in them already."""
    attitude = rolling(7)
    sonar = Sonar(SensorConfig(array=array, mount=MountConfig(yaw=yaw)))
    marks = sonar.in_sensor_axes(Bearings.of(np.zeros(len(TRUE)), TRUE), pose_of(attitude))
    assert_allclose(wrap_angle(measured(marks, attitude, array, yaw) - TRUE), 0.0, atol=1e-7)


@pytest.mark.parametrize('array', ['omnidirectional', 'linear'])
def test_sensor_whose_axes_are_upside_down_is_taken_for_level(array) -> None:
    """Its z axis down, as some drivers have it: only the heading of its x axis counts."""
    heading = np.linspace(-3.0, 3.0, len(TRUE))
    angles = np.stack([heading, 0.0 * heading, np.full(len(TRUE), np.pi)], axis=1)
    marks = Bearings.of(np.zeros(len(TRUE)), wrap_angle(TRUE - heading))
    found = measured(marks, Rotation.from_euler('ZYX', angles), array, 0.0)
    assert_allclose(wrap_angle(found - TRUE), 0.0, atol=1e-7)
