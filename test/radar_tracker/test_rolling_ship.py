# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A radar on a platform that rolls, pitches and swings its mount about."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.mounting import arm_velocity, in_sensor_axes, sensor_pose
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import MountConfig, SensorConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Coverage, Plots
from tracking_core.config import with_values
from tracking_core.platform_pose import PlatformPose

MOUNT = MountConfig(x=30.0, y=-8.0, z=12.0, yaw=0.4)
LEVEL = MountConfig()
TRUE = np.radians([0.0, 37.0, 90.0, 151.0, -120.0, -45.0])  # bearings from the sensor
DISTANCE = np.linspace(2e3, 12e3, len(TRUE))


def rolling(seed):
    """Return own ship at the time of each plot, rolling and pitching by up to 15 degrees."""
    M, rng = len(TRUE), np.random.default_rng(seed)
    angles = np.stack([rng.uniform(-3.0, 3.0, M), *rng.uniform(-0.26, 0.26, (2, M))], axis=1)
    return PlatformPose(
        position=rng.normal(0.0, 100.0, (M, 3)),
        orientation=Rotation.from_euler('ZYX', angles).as_quat(),
        velocity=np.zeros((M, 3)),
        position_covariance=np.zeros((M, 3, 3)),
        yaw_variance=np.zeros(M),
        turn_rate=rng.normal(0.0, 0.3, (M, 3)),
    )


def placed(plots, pose, mount, dimensions=2):
    """Return where the radar has the plots, from the sensor."""
    radar = Radar(SensorConfig(mount=mount), dimensions, bool(np.isfinite(plots.range).any()))
    scan = radar.measure(plots, pose, Coverage(0.0, 1.0), 1.0)
    return scan.position - sensor_pose(pose, mount)[1][:, :dimensions]


def on_the_ground():
    """Return the true places (M, 2) from the sensor."""
    return DISTANCE[:, None] * np.stack([np.cos(TRUE), np.sin(TRUE)], axis=1)


@pytest.mark.parametrize('mount', [LEVEL, MOUNT])
@pytest.mark.parametrize('seed', range(5))
def test_fan_beam_on_a_rolling_deck_keeps_range_and_bearing(mount, seed):
    """The azimuth is the contact's direction on the deck; the range is that over the ground."""
    pose = rolling(seed)
    turn, _ = sensor_pose(pose, mount)
    ray = np.stack([np.cos(TRUE), np.sin(TRUE), np.zeros_like(TRUE)], axis=1)
    x, y, _ = np.einsum('mji,mj->mi', turn, ray).T
    plots = Plots.polar(np.zeros(len(TRUE)), DISTANCE, np.arctan2(y, x))
    np.testing.assert_allclose(placed(plots, pose, mount), on_the_ground(), atol=1e-6)


@pytest.mark.parametrize('mount', [LEVEL, MOUNT])
@pytest.mark.parametrize('told', ['polar', 'cartesian', 'polar 3-D', 'cartesian 3-D'])
def test_true_directions_stay_true_on_a_rolling_deck(mount, told):
    """Plots in the axes of the tracking frame come out as they went in, whatever the attitude."""
    pose, nothing, height = rolling(7), np.zeros(len(TRUE)), np.full(len(TRUE), 800.0)
    flat, solid = on_the_ground(), np.column_stack([on_the_ground(), height])
    slant = np.linalg.norm(solid, axis=1)
    plots, expected = {
        'polar': (Plots.polar(nothing, DISTANCE, TRUE), flat),
        'cartesian': (Plots.cartesian(nothing, flat), flat),
        'polar 3-D': (
            Plots.polar(nothing, slant, TRUE, elevation=np.arcsin(height / slant)), solid,
        ),
        'cartesian 3-D': (Plots.cartesian(nothing, solid), solid),
    }[told]  # fmt: skip
    back = in_sensor_axes(plots, pose, mount)
    np.testing.assert_allclose(placed(back, pose, mount, expected.shape[1]), expected, atol=1e-6)


def test_sensor_moves_as_its_mount_is_swung():
    """Oracle: the place of the sensor a moment before and after."""
    pose, step = rolling(3), 1e-4

    def place(sign):
        on = Rotation.from_rotvec(sign * step * pose.turn_rate)
        turned = (Rotation.from_quat(pose.orientation) * on).as_quat()
        return sensor_pose(replace(pose, orientation=turned), MOUNT)[1]

    moved = (place(1.0) - place(-1.0)) / (2.0 * step)
    np.testing.assert_allclose(arm_velocity(pose, MOUNT), moved, atol=1e-5)
    plots = Plots.polar(np.zeros(len(TRUE)), DISTANCE, TRUE)
    radar = Radar(SensorConfig(mount=MOUNT), 2, is_polar=True)
    scan = radar.measure(plots, pose, Coverage(0.0, 1.0), 1.0)
    np.testing.assert_allclose(scan.sensor_velocity, moved, atol=1e-5)


def test_nothing_seen_from_a_turned_mount_is_a_look() -> None:
    """An empty scan of a 2-D radar; scipy 1.11 makes no rotations of nothing."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'sensor.mount.yaw': 1.0}))
    nothing = np.zeros(0)
    plots = replace(Plots.polar(nothing, nothing, nothing), stamp=5.0)
    assert len(tracker.track(plots)) == 0
    assert tracker.coverage.end_time == 5.0
