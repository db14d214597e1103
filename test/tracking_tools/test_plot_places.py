# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures show plots where the node takes them to be, also from a ship that moves and turns."""

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from radar_tracker.sensor_config import MountConfig, SensorConfig
from tracking_core.platform import Platform
from tracking_tools.plot_places import PlotPlaces
from tracking_tools.scene import turn_rate

BUOYS = np.array([[2000.0, 500.0], [-300.0, 900.0]])
STAMP, PLACE, YAW, MOUNT = 100.0, np.array([40.0, -70.0]), 0.7, MountConfig(x=5.0, y=1.0, yaw=0.3)
ARM = np.array([5.0 * np.cos(YAW) - np.sin(YAW), 5.0 * np.sin(YAW) + np.cos(YAW)])
LINE = BUOYS - PLACE - ARM
DISTANCE, TRUE = np.hypot(*LINE.T), np.arctan2(LINE[:, 1], LINE[:, 0])
TOLD = {
    'relative': ('radar', {'range': DISTANCE, 'azimuth': TRUE - YAW - 0.3}, {}),
    'head-up': (
        'radar',
        {'range': DISTANCE, 'azimuth': YAW + 0.3 - TRUE},
        {'azimuth_convention': 'clockwise'},
    ),
    'north-up': (
        'radar',
        {'range': DISTANCE, 'azimuth': 0.5 * np.pi - TRUE},
        {'azimuth_convention': 'compass', 'azimuth_reference': 'tracking_frame'},
    ),
    'in the tracking frame': ('odom', {'range': DISTANCE, 'azimuth': TRUE}, {}),
}


def ship():
    """Return own ship at the time of the plots."""
    return Platform(
        time=np.array([STAMP]),
        position=np.array([[*PLACE, 0.0]]),
        orientation=np.array([[0.0, 0.0, np.sin(0.5 * YAW), np.cos(0.5 * YAW)]]),
        velocity=np.zeros((1, 3)),
        position_covariance=np.zeros((1, 3, 3)),
        yaw_variance=np.zeros(1),
    )


@pytest.mark.parametrize('told', TOLD)
def test_plots_are_placed_as_they_are_told(told):
    """The buoys are where they are; so is the radar."""
    frame, columns, values = TOLD[told]
    places = PlotPlaces(SensorConfig(mount=MOUNT, **values), {}, ship(), 'odom')
    found = places.of(from_columns(columns, STAMP, frame, rosbags_types()))
    np.testing.assert_allclose(np.stack([found['x'], found['y']], axis=1), BUOYS, atol=1e-6)
    np.testing.assert_allclose([found['sensor_x'][0], found['sensor_y'][0]], PLACE + ARM)


def test_places_in_the_tracking_frame_stay():
    """Own ship has nothing to do with them."""
    msg = from_columns(dict(zip('xy', BUOYS.T, strict=True)), STAMP, 'odom', rosbags_types())
    found = PlotPlaces(SensorConfig(), {}, ship(), 'odom').of(msg)
    np.testing.assert_allclose(np.stack([found['x'], found['y']], axis=1), BUOYS)


def test_plots_that_nobody_can_place_are_left_out():
    """Those of another frame without own ship, and messages that cannot be read."""
    frame, columns, _ = TOLD['relative']
    places = PlotPlaces(SensorConfig(), {}, None, 'odom')
    assert len(places.of(from_columns(columns, STAMP, frame, rosbags_types()))['time']) == 0
    bad = from_columns({'range': DISTANCE}, STAMP, 'odom', rosbags_types())
    assert len(places.of(bad)['time']) == 0


def test_truth_without_velocities_does_not_turn():
    """A picture needs only id and place of the truth."""
    path = {'time': np.arange(3.0), 'x': np.arange(3.0), 'y': np.zeros(3)}
    np.testing.assert_array_equal(turn_rate(path), np.zeros(3))
