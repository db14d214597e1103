# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots in the frame of a sensor whose place comes from tf2: against a stand-in of its API."""

from dataclasses import replace
from importlib.util import find_spec
from logging import getLogger
from pathlib import Path

from geometry_msgs.msg import TransformStamped
import numpy as np
import pytest

from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.config import with_values
from tracking_tools.testing import confirmed_ids

STAND_IN = Path(__file__).parent / 'tf2_stand_in'
USE_TF = ('use_tf:=true', 'tracking_frame:=map', 'scan.assembly:=snapshot')
SPEED, TURN = 20.0, 0.02  # of the platform [m/s], [rad/s]
CONTACT = np.array([9000.0, 4000.0])  # at rest in the map [m]


@pytest.fixture
def with_tf2(monkeypatch):
    """Put the stand-in where nodes look for tf2_ros."""
    monkeypatch.setenv('PYTHONPATH', str(STAND_IN), prepend=':')


def where(stamp, start, swing=0.0):
    """Return position [m] and heading [rad] of the sensor: a turning ship that may swing [rad]."""
    heading = TURN * (stamp - start) + swing * np.sin(2.0 * (stamp - start))
    return np.array([SPEED * (stamp - start), -300.0]), heading


def transform(stamp, start, swing=0.0):
    """Return where the sensor's frame is in the map."""
    (x, y), heading = where(stamp, start, swing)
    msg = TransformStamped(header=rclpy_types().header(stamp, 'map'), child_frame_id='radar')
    msg.transform.translation.x, msg.transform.translation.y = float(x), float(y)
    msg.transform.rotation.z, msg.transform.rotation.w = np.sin(heading / 2), np.cos(heading / 2)
    return msg


def plots(stamp, start):
    """Return the contact as the radar sees it."""
    place, heading = where(stamp, start)
    x, y = CONTACT - place
    azimuth = np.arctan2(y, x) - heading
    return {'range': np.array([np.hypot(x, y)]), 'azimuth': np.array([azimuth])}


def test_contact_at_rest_stands_still_in_the_map(with_tf2, start_node, probe):
    """The sensor turns and moves; its transforms come after the plots, which wait for them."""
    start_node(*USE_TF, 'tf_patience:=20.0')
    transforms = probe.tell(TransformStamped, '/tf_stand_in')
    probe.peer.wait_until_matched(transforms)
    start = probe.stamp
    for stamp in (start - 1.0, start + 2.0):
        transforms.publish(transform(stamp, start))
    probe.meet()
    for step in range(10):
        probe.stamp = start + 4.0 * (step + 1)
        probe.send(plots(probe.stamp, start), probe.stamp)
        transforms.publish(transform(probe.stamp - 2.0, start))
        transforms.publish(transform(probe.stamp, start))
        probe.spin_until(lambda: probe.is_answered(probe.stamp), 'tracks')
    table = to_columns(probe.tables[-1], 9)
    (row,) = np.flatnonzero(table['status'] == 1)
    # Exact plots; what is left is the way of the transform between two that were sent.
    assert np.hypot(table['x'][row] - CONTACT[0], table['y'][row] - CONTACT[1]) < 5.0
    assert table['speed'][row] < 1.0
    assert probe.tables[-1].header.frame_id == 'map'


def test_ship_that_swings_is_known_at_every_plot(with_tf2, start_node, probe):
    """By 0.1 rad to either side within pi seconds, and a turn of the antenna lasts four."""
    start_node(*USE_TF, 'tf_patience:=20.0', 'initiation.speed_max:=20.0')
    transforms = probe.tell(TransformStamped, '/tf_stand_in')
    probe.peer.wait_until_matched(transforms)
    start, contacts = probe.stamp, CONTACT * [[1.0], [-1.0], [1.5], [-1.5]]
    offsets = np.array([0.6, 1.4, 2.3, 3.1])  # s after the stamp
    for stamp in (start - 1.0, start + 2.0):
        transforms.publish(transform(stamp, start))
    probe.meet()
    for step in range(12):
        probe.stamp = start + 4.0 * (step + 1)
        for part in range(-8, 80):
            transforms.publish(transform(probe.stamp + 0.05 * part, start, swing=0.1))
        there = [where(stamp, start, swing=0.1) for stamp in probe.stamp + offsets]
        line = contacts - np.array([place for place, _ in there])
        azimuth = np.arctan2(line[:, 1], line[:, 0]) - [heading for _, heading in there]
        columns = {'range': np.hypot(*line.T), 'azimuth': azimuth, 'time': offsets}
        probe.send(columns, probe.stamp)
        probe.spin_until(lambda: probe.is_answered(probe.stamp), 'tracks')
    table = to_columns(probe.tables[-1], 9)
    assert confirmed_ids(table) == {1, 2, 3, 4}
    place = np.stack([table['x'], table['y']], axis=1)
    off = np.hypot(*(place[:, None] - contacts).transpose(2, 0, 1))
    assert off.min(axis=0).max() < 20.0
    assert table['speed'].max() < 2.0


def test_one_stamp_an_hour_ahead_costs_no_transform(with_tf2, start_node, probe):
    """Nobody knows where the sensor will be then, and where it was before is kept."""
    node = start_node(*USE_TF, 'tf_patience:=0.1')
    transforms = probe.tell(TransformStamped, '/tf_stand_in')
    probe.peer.wait_until_matched(transforms)
    start = probe.stamp
    for second in range(-1, 40):
        transforms.publish(transform(start + second, start))
    probe.meet()
    for step in range(8):
        probe.stamp = start + 4.0 * (step + 1)
        if step == 5:
            probe.send(plots(probe.stamp, start), probe.stamp + 3600.0)
            node.wait_for_line('plots message refused: no transform')
        table = probe.answer(plots(probe.stamp, start))
    assert len(table['id'][table['status'] == 1]) == 1


def test_plots_without_a_transform_are_dropped_in_time_and_told(with_tf2, start_node, probe):
    """The wait is bounded; the reason names both frames and is counted."""
    node = start_node(*USE_TF, 'tf_patience:=0.1')
    probe.peer.wait_until_matched(probe.plots)
    key = 'plots refused: no transform'

    def is_told():
        probe.stamp += 1.0
        probe.send(plots(probe.stamp, probe.stamp), probe.stamp)
        return probe.diagnosed(key) not in (None, '0')

    probe.spin_until(is_told, key)
    assert "no transform from 'radar' to 'map': \"radar\" passed to lookupTransform" in node.log
    assert not probe.tables


@pytest.mark.skipif(find_spec('tf2_ros') is not None, reason='it is installed')
def test_use_tf_without_tf2_is_refused_at_the_start(start_node):
    """Nothing is promised that does not come."""
    node = start_node(*USE_TF)
    assert node.wait() == 1
    assert 'tf2_ros is not installed' in node.log
    assert 'Traceback' not in node.log


def test_use_tf_needs_a_tracking_frame_and_no_mount():
    """The frame could be any; the mount would count twice."""
    with pytest.raises(ValueError, match='use_tf needs a tracking_frame'):
        replace(radar_node_config(), use_tf=True)
    node = replace(radar_node_config(), use_tf=True, tracking_frame='map')
    tracker = with_values(RadarTrackerConfig(), {'sensor.mount.x': 3.0})
    session = radar_session(tracker, node, rclpy_types(), getLogger('test'))
    with pytest.raises(ValueError, match='tf2 knows the mount'):
        session.use_transforms(None)
