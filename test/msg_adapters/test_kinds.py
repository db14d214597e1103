# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots and bearings in other messages than PointCloud2, made of the classes that ROS has."""

from dataclasses import replace

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.bearings import to_bearings
from msg_adapters.kinds.menu import check_type, message_class
from msg_adapters.plots import to_plots
from radar_tracker.sensor_config import SensorConfig
from sonar_tracker.sensor_config import SensorConfig as SonarConfig

rosbags = pytest.importorskip('rosbags.typesys')
RADAR, SONAR = SensorConfig(), SonarConfig()
DEFINITIONS = {
    'radar_msgs/msg/RadarReturn': 'float32 range\nfloat32 azimuth\nfloat32 elevation\n'
    'float32 doppler_velocity\nfloat32 amplitude\n',
    'radar_msgs/msg/RadarScan': 'std_msgs/Header header\nradar_msgs/RadarReturn[] returns\n',
    'marine_acoustic_msgs/msg/PingInfo': 'float32 frequency\nfloat32 sound_speed\n'
    'float32[] tx_beamwidths\nfloat32[] rx_beamwidths\n',
    'marine_acoustic_msgs/msg/DetectionFlag': 'uint8 flag\n',
    'marine_acoustic_msgs/msg/SonarDetections': 'std_msgs/Header header\nPingInfo ping_info\n'
    'DetectionFlag[] flags\nfloat32[] two_way_travel_times\nfloat32[] tx_delays\n'
    'float32[] intensities\nfloat32[] tx_angles\nfloat32[] rx_angles\n',
    'marine_sensor_msgs/msg/RadarSector': 'std_msgs/Header header\nfloat32 angle_start\n',
    'vision_msgs/msg/ObjectHypothesis': 'string class_id\nfloat64 score\n',
    'vision_msgs/msg/ObjectHypothesisWithPose': 'vision_msgs/ObjectHypothesis hypothesis\n'
    'geometry_msgs/PoseWithCovariance pose\n',
    'vision_msgs/msg/BoundingBox3D': 'geometry_msgs/Pose center\ngeometry_msgs/Vector3 size\n',
    'vision_msgs/msg/Detection3D': 'std_msgs/Header header\n'
    'vision_msgs/ObjectHypothesisWithPose[] results\nvision_msgs/BoundingBox3D bbox\nstring id\n',
    'vision_msgs/msg/Detection3DArray': 'std_msgs/Header header\n'
    'vision_msgs/Detection3D[] detections\n',
}


@pytest.fixture(scope='module')
def ros():
    """Return a maker of messages by type, of the classes that rosbags builds from definitions."""
    store = rosbags.get_typestore(rosbags.Stores.ROS2_JAZZY)
    for name, text in DEFINITIONS.items():
        store.register(rosbags.get_types_from_msg(text, name))

    def make(name, **values):
        return store.types[name.replace('/', '/msg/')](**values)

    return make


def header(ros, frame='sensor'):
    """Return a header at 100 s."""
    return ros('std_msgs/Header', stamp=ros('builtin_interfaces/Time', sec=100, nanosec=0),
               frame_id=frame)  # fmt: skip


def pose(ros, x, y, z=0.0, yaw=0.0):
    """Return a pose with a heading."""
    turn = ros('geometry_msgs/Quaternion', x=0.0, y=0.0, z=np.sin(yaw / 2), w=np.cos(yaw / 2))
    return ros(
        'geometry_msgs/Pose', position=ros('geometry_msgs/Point', x=x, y=y, z=z), orientation=turn
    )


def radar_scan(ros, *rows):
    """Return returns of range, azimuth, elevation, range rate and amplitude."""
    names = ('range', 'azimuth', 'elevation', 'doppler_velocity', 'amplitude')
    returns = [ros('radar_msgs/RadarReturn', **dict(zip(names, r, strict=True))) for r in rows]
    return ros('radar_msgs/RadarScan', header=header(ros), returns=returns)


def test_radar_scan_has_range_rate_and_elevation(ros):
    """All of the message is read; a bad return goes alone."""
    msg = radar_scan(ros, (1e3, 0.5, 0.1, -7.0, 3.0), (np.nan, 0.0, 0.1, 0.0, 0.0))
    reading = to_plots(msg, RADAR, 9)
    plots = reading.plots
    assert [plots.range, plots.azimuth, plots.elevation, plots.range_rate] == [1e3, 0.5, 0.1, -7.0]
    assert reading.dropped == {'range is not a number': 1}
    assert (plots.stamp, plots.frame) == (100.0, 'sensor')


def test_radar_scan_of_a_2d_radar_has_no_elevation(ros):
    """The message says 0 for what is not measured."""
    plots = to_plots(radar_scan(ros, (1e3, 0.5, 0.0, 1.0, 0.0)), RADAR, 9).plots
    assert np.isnan(plots.elevation).all()


def test_radar_scan_of_a_radar_without_doppler_has_no_range_rate(ros):
    """0 for all returns is no speed: contacts that move would be drawn back to rest."""
    rows = [(1e3, 0.5, 0.1, 0.0, 3.0), (2e3, 0.7, 0.1, 0.0, 5.0)]
    assert np.isnan(to_plots(radar_scan(ros, *rows), RADAR, 9).plots.range_rate).all()
    measured = to_plots(radar_scan(ros, *rows, (2e3, 0.9, 0.1, 0.1, 5.0)), RADAR, 9)
    np.testing.assert_allclose(measured.plots.range_rate, [0.0, 0.0, 0.1])


def test_empty_messages_are_scans_without_plots(ros):
    """A look that saw nothing is a look."""
    assert len(to_plots(radar_scan(ros), RADAR, 9).plots) == 0
    empty = ros('geometry_msgs/PoseArray', header=header(ros), poses=[])
    assert len(to_plots(empty, RADAR, 9).plots) == 0


def test_more_rows_than_allowed_are_refused(ros):
    """The limit holds for every type."""
    with pytest.raises(BadMessage, match='radar_msgs/RadarScan has 3 rows, limit 2'):
        to_plots(radar_scan(ros, *[(1e3, 0.5, 0.1, 0.0, 0.0)] * 3), RADAR, 2)


def laser_values():
    """Return a scan of five rays, two of them echoes."""
    return {
        'angle_min': -0.2, 'angle_max': 0.2, 'angle_increment': 0.1, 'time_increment': 0.5,
        'scan_time': 2.5, 'range_min': 1.0, 'range_max': 90.0,
    }  # fmt: skip


def check_laser(msg):
    """Compare with the two echoes that are there."""
    plots = to_plots(msg, RADAR, 9).plots
    np.testing.assert_allclose(plots.range, [10.0, 20.0])
    np.testing.assert_allclose(plots.azimuth, [-0.1, 0.2], atol=1e-7)
    np.testing.assert_allclose(plots.time, [100.5, 102.0])


def test_laser_scan_of_rosbags(ros):
    """Rays without an echo are no plots, each echo has its own time."""
    ranges = np.array([np.inf, 10.0, -np.inf, np.nan, 20.0], np.float32)
    none = np.zeros(0, np.float32)
    check_laser(
        ros('sensor_msgs/LaserScan', header=header(ros), ranges=ranges, intensities=none,
            **laser_values())
    )  # fmt: skip


def test_laser_scan_without_a_limit_has_no_echo_at_infinity(ros):
    """A ray without an echo is +inf, also where range_max is; a scan of such saw nothing."""
    none = np.zeros(0, np.float32)
    limits = {**laser_values(), 'range_max': np.inf}
    for ranges in ([np.inf, 10.0, np.nan], [np.inf, np.inf, np.inf]):
        rays = np.array(ranges, np.float32)
        reading = to_plots(
            ros('sensor_msgs/LaserScan', header=header(ros), ranges=rays, intensities=none,
                **limits), RADAR, 9)  # fmt: skip
        assert reading.plots.range.tolist() == [10.0] * ranges.count(10.0)
        assert reading.dropped == {}


def test_laser_scan_whose_limits_no_echo_can_keep_is_refused(ros):
    """As of a driver that leaves them 0: no look that saw nothing, but an empty one is."""
    none = np.zeros(0, np.float32)
    parts = {'header': header(ros), 'intensities': none, **laser_values(), 'range_max': 0.0}
    with pytest.raises(BadMessage, match='range_min = 1, range_max = 0'):
        to_plots(ros('sensor_msgs/LaserScan', ranges=np.ones(3, np.float32), **parts), RADAR, 9)
    assert len(to_plots(ros('sensor_msgs/LaserScan', ranges=none, **parts), RADAR, 9).plots) == 0


def test_laser_scan_and_poses_of_rclpy():
    """The same with the classes that a node receives."""
    sensor_msgs = pytest.importorskip('sensor_msgs.msg')
    geometry_msgs = pytest.importorskip('geometry_msgs.msg')
    msg = sensor_msgs.LaserScan(ranges=[np.inf, 10.0, -np.inf, np.nan, 20.0], **laser_values())
    msg.header.stamp.sec = 100
    check_laser(msg)
    poses = geometry_msgs.PoseArray(poses=[geometry_msgs.Pose()])
    poses.poses[0].position.x = 5.0
    np.testing.assert_array_equal(to_plots(poses, RADAR, 9).plots.position, [[5.0, 0.0, 0.0]])


def test_pose_array_is_positions(ros):
    """Orientations say nothing of a plot."""
    poses = [pose(ros, 1.0, 2.0, 3.0), pose(ros, 4.0, 5.0, 6.0, yaw=1.0)]
    msg = ros('geometry_msgs/PoseArray', header=header(ros), poses=poses)
    plots = to_plots(msg, RADAR, 9).plots
    np.testing.assert_array_equal(plots.position, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])


@pytest.mark.parametrize(('variance', 'sd'), [(0.04, 0.2), (0.0, np.nan), (-1.0, np.nan)])
def test_pose_with_covariance_is_a_position_or_a_bearing(ros, variance, sd):
    """A radar takes where it is, a sonar where it points."""
    covariance = np.zeros(36)
    covariance[35] = variance
    told = ros('geometry_msgs/PoseWithCovariance', pose=pose(ros, 7.0, 8.0, 9.0, yaw=-2.5),
               covariance=covariance)  # fmt: skip
    msg = ros('geometry_msgs/PoseWithCovarianceStamped', header=header(ros), pose=told)
    np.testing.assert_array_equal(to_plots(msg, RADAR, 9).plots.position, [[7.0, 8.0, 9.0]])
    marks = to_bearings(msg, SONAR, 9).plots
    np.testing.assert_allclose(marks.bearing, [-2.5])
    np.testing.assert_allclose(marks.bearing_sd, [sd])
    in_degrees = to_bearings(msg, replace(SONAR, angle_unit='deg'), 9).plots
    np.testing.assert_allclose(in_degrees.bearing, [-2.5])  # a quaternion has no unit


def test_detections_are_where_the_best_hypothesis_says(ros):
    """Without a hypothesis the box says it."""

    def hypothesis(score, x):
        told = ros('geometry_msgs/PoseWithCovariance', pose=pose(ros, x, 0.0),
                   covariance=np.zeros(36))  # fmt: skip
        named = ros('vision_msgs/ObjectHypothesis', class_id='a', score=score)
        return ros('vision_msgs/ObjectHypothesisWithPose', hypothesis=named, pose=told)

    size = ros('geometry_msgs/Vector3', x=1.0, y=1.0, z=1.0)
    box = ros('vision_msgs/BoundingBox3D', center=pose(ros, 30.0, 4.0), size=size)
    found = [
        ros('vision_msgs/Detection3D', header=header(ros), results=results, bbox=box, id='')
        for results in (
            [hypothesis(0.2, 10.0), hypothesis(0.7, 20.0)],
            [],
            [hypothesis(0.9, 0.0)],  # of a detector that tells a class, and leaves the pose alone
        )
    ]
    msg = ros('vision_msgs/Detection3DArray', header=header(ros), detections=found)
    plots = to_plots(msg, RADAR, 9).plots
    np.testing.assert_array_equal(plots.position[:, :2], [[20.0, 0.0], [30.0, 4.0], [30.0, 4.0]])


def detections(ros, speed=1500.0, **changes):
    """Return three detections of a sonar, the second flagged as bad."""
    none = np.zeros(0, np.float32)
    info = ros('marine_acoustic_msgs/PingInfo', frequency=2e5, sound_speed=speed,
               tx_beamwidths=none, rx_beamwidths=none)  # fmt: skip
    values = {
        'flags': [ros('marine_acoustic_msgs/DetectionFlag', flag=flag) for flag in (0, 4, 0)],
        'two_way_travel_times': np.array([1.0, 2.0, 3.0]), 'tx_delays': np.array([0.0, 0.0, 0.5]),
        'intensities': none, 'tx_angles': none, 'rx_angles': np.array([0.3, 0.0, -0.1]),
    }  # fmt: skip
    return ros('marine_acoustic_msgs/SonarDetections', header=header(ros), ping_info=info,
               **{**values, **changes})  # fmt: skip


def test_sonar_detections_are_counted_to_port_and_timed_at_the_echo(ros):
    """Angles of the message are positive to starboard; it is stamped when the ping left."""
    plots = to_plots(detections(ros), RADAR, 9).plots
    np.testing.assert_allclose(plots.range, [750.0, 2250.0])
    np.testing.assert_allclose(plots.azimuth, [-0.3, 0.1])
    np.testing.assert_allclose(plots.time, [100.5, 102.0])
    np.testing.assert_allclose(to_bearings(detections(ros), SONAR, 9).plots.bearing, [-0.3, 0.1])


def test_sonar_detections_that_do_not_fit_are_refused(ros):
    """The reason names the field and its value."""
    with pytest.raises(BadMessage, match='sound_speed is 0 m/s'):
        to_plots(detections(ros, speed=0.0), RADAR, 9)
    with pytest.raises(BadMessage, match='two_way_travel_times 3, rx_angles 2'):
        to_plots(detections(ros, rx_angles=np.zeros(2)), RADAR, 9)


def test_raw_echoes_are_refused_with_what_is_needed_first(ros):
    """A sector of echoes holds no plots."""
    msg = ros('marine_sensor_msgs/RadarSector', header=header(ros), angle_start=0.0)
    with pytest.raises(BadMessage, match='raw echoes, not plots: a plot extractor'):
        to_plots(msg, RADAR, 9)


def test_types_are_named_as_ros_names_them():
    """Both spellings are the same type; an unknown one is refused with the menu."""
    assert check_type('radar_msgs/msg/RadarScan') == 'radar_msgs/RadarScan'
    with pytest.raises(
        ValueError, match="'std_msgs/String' cannot be read, one of: sensor_msgs/P"
    ):
        check_type('std_msgs/String')


def test_package_that_is_not_installed_is_named():
    """The error says what to install and what is there."""
    with pytest.raises(ValueError, match=r'needs the package radar_msgs.*ros-.*-radar-msgs'):
        message_class('radar_msgs/RadarScan')


@pytest.mark.parametrize('value', [1e160, -1e300, np.inf, np.nan])
def test_turn_beyond_all_numbers_is_no_direction(ros, value):
    """A quaternion of Python's floats: their squares may be too large for one."""
    odd = pose(ros, 7.0, 8.0)
    odd.orientation.z = odd.orientation.x = value
    told = ros('geometry_msgs/PoseWithCovariance', pose=odd, covariance=np.zeros(36))
    msg = ros('geometry_msgs/PoseWithCovarianceStamped', header=header(ros), pose=told)
    assert len(to_plots(msg, RADAR, 9).plots) == 1
    with pytest.raises(BadMessage, match=r'bearing is not a number \(1\)'):
        to_bearings(msg, SONAR, 9)
