# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that read other messages than PointCloud2, over the middleware."""

from geometry_msgs.msg import Pose, PoseArray, PoseWithCovarianceStamped
import numpy as np
import pytest
from rcl_interfaces.srv import GetParameters

from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns


@pytest.fixture
def sensor(request, radar, sonar):
    """Return the radar, or the sonar for tests that say so."""
    return sonar if getattr(request, 'param', '') == 'sonar' else radar


def answer(probe, publisher, msg):
    """Publish a message and return the track table that answers it."""
    publisher.publish(msg)
    probe.spin_until(lambda: probe.tables[-1].header.stamp == msg.header.stamp, 'tracks')
    return to_columns(probe.tables[-1], 100)


def first_publisher(probe, make):
    """Return a publisher of the sensor's topic whose messages are answered."""
    probe.node.destroy_publisher(probe.plots)
    publisher = probe.node.create_publisher(type(make(0.0)), probe.sensor.topic, 50)
    stamps = iter(np.arange(90.0, 100.0, 1e-3))

    def is_heard():
        publisher.publish(make(next(stamps)))
        return probe.tables

    probe.spin_until(is_heard, 'an answer')
    return publisher


def pose_array(stamp):
    """Return one position that moves along x."""
    msg = PoseArray(header=rclpy_types().header(stamp, 'radar'), poses=[Pose()])
    msg.poses[0].position.x = 4000.0 + 10.0 * stamp
    return msg


def direction(stamp):
    """Return a pose that points to 1.2 rad."""
    msg = PoseWithCovarianceStamped(header=rclpy_types().header(stamp, 'sonar'))
    msg.pose.pose.orientation.z, msg.pose.pose.orientation.w = np.sin(0.6), np.cos(0.6)
    msg.pose.covariance[35] = 1e-5
    return msg


def test_radar_node_tracks_the_positions_of_a_pose_array(start_node, probe):
    """A parameter is all that it takes."""
    start_node('input_type:=geometry_msgs/PoseArray')
    plots = first_publisher(probe, pose_array)
    request = GetParameters.Request(names=['input_types_available', 'output_types_available'])
    told = probe.call(GetParameters, '/radar_tracker/get_parameters', request, again=1.0)
    assert 'geometry_msgs/PoseArray' in told.values[0].string_array_value
    assert told.values[1].string_array_value == ['none']  # radar_msgs has no wheel
    for step in range(10):
        table = answer(probe, plots, pose_array(100.0 + 4.0 * step))
    (row,) = np.flatnonzero(table['status'] == 1)
    assert abs(table['x'][row] - 5360.0) < 90.0  # three sigma of a plot


@pytest.mark.parametrize('sensor', ['sonar'], indirect=True)
def test_sonar_node_tracks_the_yaw_of_a_pose(start_node, probe):
    """A direction of arrival is a bearing."""
    start_node('input_type:=geometry_msgs/msg/PoseWithCovarianceStamped')
    bearings = first_publisher(probe, direction)
    for step in range(12):
        table = answer(probe, bearings, direction(100.0 + 4.0 * step))
    (row,) = np.flatnonzero(table['status'] == 1)
    assert abs(table['bearing'][row] - 1.2) < 0.01


@pytest.mark.parametrize(
    ('type_', 'words'),
    [
        (
            'input_type:=radar_msgs/RadarScan',
            'needs the package radar_msgs, which is not installed',
        ),
        ('input_type:=marine_sensor_msgs/RadarSector', 'raw echoes, not plots: a plot extractor'),
        ('input_type:=std_msgs/String', "'std_msgs/String' cannot be read, one of: sensor_msgs/P"),
        ('output_type:=radar_msgs/RadarTracks', 'needs the package radar_msgs, which is not'),
    ],
)
def test_type_that_cannot_be_used_ends_the_node_with_a_word(start_node, type_, words):
    """Nothing is subscribed or promised in vain."""
    node = start_node(type_)
    assert node.wait() == 1
    assert words in node.log
    assert 'Traceback' not in node.log
