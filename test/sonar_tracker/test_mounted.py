# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A sonar that is turned on a ship which turns: where does it look, and when?"""

from __future__ import annotations

import logging

import numpy as np
from numpy.testing import assert_allclose
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

MOUNT = {'sensor.mount.yaw': 0.4}
TURN = np.radians(3.0)  # of own ship [rad/s]


def ship(duration: float, heading: float = 0.5 * np.pi, rate: float = 0.0) -> Platform:
    """Own ship at (300, 400) m, which turns evenly."""
    time = np.arange(-2.0, duration + 2.0, 0.5)
    K, yaw = len(time), heading + rate * time
    turn = np.stack([0.0 * yaw, 0.0 * yaw, np.sin(0.5 * yaw), np.cos(0.5 * yaw)], axis=1)
    place = np.tile([300.0, 400.0, 0.0], (K, 1))
    return Platform(time, place, turn, 0.0 * place, np.zeros((K, 3, 3)), np.zeros(K))


def tracker_of(**values: object) -> SonarTracker:
    """Return a tracker of the mounted sonar."""
    return SonarTracker(with_values(SonarTrackerConfig(), {**MOUNT, **values}))


@pytest.mark.parametrize(('bearing', 'is_inside'), [(0.8, True), (1.0, False),
                                                    (0.0, True), (-0.2, False)])  # fmt: skip
def test_sector_turns_with_ship_and_mount(bearing: float, is_inside: bool) -> None:
    """To starboard of a ship to the north, 0.4 rad further to port: 0.4 +- 0.5 rad."""
    sector = {'sensor.sector_centre': -0.5 * np.pi, 'sensor.sector_width': 1.0}
    tracker = tracker_of(**sector)
    nothing = np.zeros(0)
    for time in (0.0, 2.0, 4.0):
        tracker.track(Bearings(nothing, nothing, nothing, nothing, time), ship(4.0))
        if time == 0.0:
            tracker.start_track(np.array([bearing]), time)
    existence = tracker.tracks.existence_probability
    assert (existence < 0.95) if is_inside else (existence > 0.99)


def test_marks_of_one_cycle_are_each_turned_by_the_heading_of_their_time() -> None:
    """Of a cycle of two seconds, while the ship turns by six degrees."""
    truth, later = np.array([-2.5, -1.0, 0.3, 2.0]), np.array([0.0, 0.6, 1.2, 1.8])
    tracker, platform = tracker_of(), ship(60.0, rate=TURN)
    for cycle in range(25):
        time = 2.0 * cycle + later
        heading = platform.at(time).yaw + MOUNT['sensor.mount.yaw']
        tracker.track(Bearings.of(time, wrap_angle(truth - heading)), platform)
    tracks = tracker.tracks
    assert tracks.confirmed.sum() == 4
    found = bearing_states(tracks)
    assert_allclose(np.sort(found.bearing), truth, atol=1e-3)
    assert_allclose(found.bearing_rate, 0.0, atol=1e-4)


@pytest.mark.parametrize('array', ['linear', 'omnidirectional'])
def test_blind_array_shows_the_mirror_image_about_its_axis(array: str) -> None:
    """Nobody else does; the axis is turned with the mount."""
    types = rosbags_types()
    values = {'sensor.mount.yaw': 0.4, 'sensor.array': array, 'sensor.sector_centre': -0.5 * np.pi}
    config = with_values(SonarTrackerConfig(), values)
    node = with_values(sonar_node_config(), {'tracking_frame': 'map'})
    session = sonar_session(config, node, types, logging.getLogger('mirror'))
    for cycle in range(10):
        columns = {'bearing': np.array([-1.0])}
        session.plots(from_columns(columns, 2.0 * cycle, 'sonar', types), 0.0)
    drawn = session.instrument.draw(set(), session.header(), node.markers).markers
    toward = {m.ns: 2.0 * np.arctan2(m.pose.orientation.z, m.pose.orientation.w) for m in drawn}
    assert toward['fan'] == pytest.approx(-0.6, abs=1e-3)
    if array == 'linear':
        assert toward['mirror'] == pytest.approx(1.4, abs=1e-3)
    else:
        assert 'mirror' not in toward


def test_on_both_sides_the_image_is_a_track_and_no_mirror() -> None:
    """About the axis, which is turned with the mount."""
    types = rosbags_types()
    values = {'sensor.mount.yaw': 0.4, 'sensor.array': 'linear', 'sensor.both_sides': True}
    config = with_values(SonarTrackerConfig(), values)
    node = with_values(sonar_node_config(), {'tracking_frame': 'map'})
    session = sonar_session(config, node, types, logging.getLogger('both'))
    for cycle in range(10):
        columns = {'bearing': np.array([-1.0])}
        session.plots(from_columns(columns, 2.0 * cycle, 'sonar', types), 0.0)
    drawn = session.instrument.draw(set(), session.header(), node.markers).markers
    fans = [2.0 * np.arctan2(m.pose.orientation.z, m.pose.orientation.w)
            for m in drawn if m.ns == 'fan']  # fmt: skip
    assert_allclose(np.sort(fans), [-0.6, 1.4], atol=1e-3)
    assert 'mirror' not in {m.ns for m in drawn}
