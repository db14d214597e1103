# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A radar on a ship that moves and turns, and that does not know everything of itself."""

from dataclasses import replace
import logging
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from msg_adapters.message_types import stamp_of
from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.mounting import in_sensor_axes
from radar_tracker.node_config import radar_node_config
from radar_tracker.platform_doubt import PlatformDoubt
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import MountConfig
from radar_tracker.session import radar_session
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Coverage, Plots
from tracking_core.config import with_values
from tracking_core.platform import Platform
from tracking_core.platform_pose import PlatformPose
from tracking_session.orders import acquire

pytest.importorskip('rosbags')
TYPES = pytest.importorskip('msg_adapters.message_types').rosbags_types()
PERIOD = 2.5  # of the antenna [s]
BUOYS = np.array([[2000.0, 500.0], [-1500.0, 1800.0], [300.0, -2200.0], [900.0, 1600.0]])
RANGE_SD, AZIMUTH_SD = 5.0, 0.002
MOUNT = ('sensor.mount.x', 'sensor.mount.y', 'sensor.mount.yaw')
QUIET = {'motion.horizontal.acceleration_sd': [0.05, 1.0]}
NOISE = {'sensor.range_sd': RANGE_SD, 'sensor.azimuth_sd': AZIMUTH_SD}


def odometry(time, place, yaw, position_variance=0.0, yaw_variance=0.0):
    """Return own ship, which lies still as far as the message tells: it must be interpolated."""
    covariance = np.zeros(36)
    covariance[[0, 7]], covariance[35] = position_variance, yaw_variance
    x, y = (float(value) for value in place)
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2)))
    pose = TYPES.Pose(position=TYPES.Point(x=x, y=y, z=0.0), orientation=turn)
    zero = TYPES.Vector3(x=0.0, y=0.0, z=0.0)
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'),
        child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=covariance),
        twist=TYPES.TwistWithCovariance(
            twist=TYPES.Twist(linear=zero, angular=zero), covariance=np.zeros(36)
        ),
    )


def circle(time):
    """Return place and heading of a ship at 10 m/s that turns by 3 degrees a second."""
    rate = np.radians(3.0)
    yaw, radius = 0.5 + rate * time, 10.0 / rate
    place = radius * np.stack([np.sin(yaw) - np.sin(0.5), np.cos(0.5) - np.cos(yaw)], axis=-1)
    return place, yaw


def seen(times, mount):
    """Return range and azimuth of the buoys at their times from a radar on the circling ship."""
    place, yaw = circle(times)
    x, y, turned = mount
    arm = Rotation.from_euler('z', yaw[:, None]).apply([x, y, 0.0])[:, :2]
    offset = BUOYS - place - arm
    azimuth = np.arctan2(offset[:, 1], offset[:, 0]) - yaw - turned
    return np.hypot(*offset.T), np.angle(np.exp(1j * azimuth))


def turn_of_antenna(number, mount, rng):
    """Return the plots of one turn, each at the time when the antenna points at it."""
    start = PERIOD * number
    times = np.full(len(BUOYS), start)
    for _ in range(10):  # where it points depends on when
        _, azimuth = seen(times, mount)
        times = start + PERIOD * (azimuth % (2.0 * np.pi)) / (2.0 * np.pi)
    distance, azimuth = seen(times, mount)
    order = np.argsort(times)
    columns = {
        'range': distance + RANGE_SD * rng.standard_normal(len(BUOYS)),
        'azimuth': azimuth + AZIMUTH_SD * rng.standard_normal(len(BUOYS)),
        'time': times - start,
    }
    plots = {name: values[order] for name, values in columns.items()}
    return from_columns(plots, 1000.0 + start, 'radar', TYPES)


@pytest.mark.parametrize('mount', [(0.0, 0.0, 0.0), (30.0, -8.0, 2.0)], ids=['bow', 'aside'])
def test_plots_from_a_turning_ship_are_each_brought_to_their_own_time(mount):
    """Buoys lie still within their noise; with one pose a turn they would move by 260 m."""
    rng = np.random.default_rng(4)
    track_buoys([turn_of_antenna(number, mount, rng) for number in range(40)], mount, {})


def track_buoys(scans, mount, values):
    """Track from the circling ship; all buoys must be where they are, and lie still."""
    placed = dict(zip(MOUNT, mount, strict=True))
    config = with_values(RadarTrackerConfig(), {**NOISE, **QUIET, **placed, **values})
    radar = radar_session(config, radar_node_config(), TYPES, logging.getLogger('own ship'))
    for number, scan in enumerate(scans):
        for time in PERIOD * number + np.arange(0.1 if number else 0.0, PERIOD + 0.05, 0.1):
            place, yaw = circle(np.array(time))
            radar.ownship(odometry(1000.0 + time, place, yaw), 0.0)
        table = to_columns(radar.plots(scan, 0.0), 100)
    rows = table['status'] == 1
    assert rows.sum() == len(BUOYS)
    apart = np.hypot(*(np.stack([table['x'], table['y']])[:, rows, None] - BUOYS.T[:, None]))
    assert apart.min(axis=0).max() < 10.0  # three sigma of a plot is 15 m
    assert table['speed'][rows].max() < 1.0


def in_other_words(told, plots, mount):
    """Return plots of the radar, told as other drivers do, and the parameters that say so."""
    columns = to_columns(plots, 100)
    stamp, distance = stamp_of(plots), columns['range']
    place, yaw = circle(stamp - 1000.0 + columns['time'])
    true = columns['azimuth'] + yaw + mount[2]
    arm = Rotation.from_euler('z', yaw[:, None]).apply([*mount[:2], 0.0])[:, :2]
    x, y = distance * np.cos(true), distance * np.sin(true)
    north_up = {'sensor.azimuth_reference': 'tracking_frame'}
    compass = {'sensor.azimuth_convention': 'compass'}
    polar = {'azimuth': (0.5 * np.pi - true) % (2.0 * np.pi), 'range': distance}
    frame, told, values = {
        'head-up': (
            'radar',
            {'azimuth': -columns['azimuth'] % (2.0 * np.pi), 'range': distance},
            {'sensor.azimuth_convention': 'clockwise'},
        ),
        'north-up': ('radar', polar, {**compass, **north_up}),
        'in the tracking frame': ('odom', polar, compass),
        'x and y, north-up': ('radar', {'x': x, 'y': y}, north_up),
        'places': (
            'odom',
            {'x': x + (place + arm)[:, 0], 'y': y + (place + arm)[:, 1]},
            # From where the antenna looks nobody tells, and its mount is in the places already.
            {'scan.assembly': 'snapshot', **dict.fromkeys(MOUNT, 0.0)},
        ),
    }[told]
    msg = from_columns({**told, 'time': columns['time']}, stamp, frame, TYPES)
    return msg, {**values, 'sensor.position_sd': 2.0 * RANGE_SD}


@pytest.mark.parametrize(
    'told', ['head-up', 'north-up', 'in the tracking frame', 'x and y, north-up', 'places']
)
def test_plots_of_a_turning_ship_may_be_told_in_any_way(told):
    """The buoys lie still in the tracking frame, whether heading and place are told or not."""
    rng, mount = np.random.default_rng(4), (30.0, -8.0, 2.0)
    scans = [turn_of_antenna(number, mount, rng) for number in range(40)]
    scans, values = zip(*(in_other_words(told, scan, mount) for scan in scans), strict=True)
    track_buoys(scans, mount, values[0])


def test_true_directions_without_times_stay_true_while_the_ship_swings():
    """Only the message has a time; the heading, 4 degrees on by the middle of a turn, is out."""
    values = {
        **NOISE,
        **QUIET,
        'scan.period': PERIOD,
        'sensor.azimuth_reference': 'tracking_frame',
    }
    config, log = with_values(RadarTrackerConfig(), values), logging.getLogger('own ship')
    radar = radar_session(config, radar_node_config(), TYPES, log)
    columns = {'range': np.hypot(*BUOYS.T), 'azimuth': np.arctan2(BUOYS[:, 1], BUOYS[:, 0])}
    for number in range(20):
        for time in PERIOD * number + np.arange(0.0, PERIOD + 0.05, 0.1):
            radar.ownship(odometry(1000.0 + time, (0.0, 0.0), circle(time)[1]), 0.0)
        msg = from_columns(columns, 1000.0 + PERIOD * number, 'radar', TYPES)
        table = to_columns(radar.plots(msg, 0.0), 100)
    rows = table['status'] == 1
    assert rows.sum() == len(BUOYS)
    apart = np.hypot(*(np.stack([table['x'], table['y']])[:, rows, None] - BUOYS.T[:, None]))
    assert apart.min(axis=0).max() < 5.0
    assert np.isnan(table['gate_z']).all()  # no plot has an elevation, turned or not


def test_noise_of_north_up_places_is_turned_with_them():
    """Oracle: rotation matrices; a height that is not known stays so, and nothing else is lost."""
    pose, place = poses(np.zeros((3, 3)), 0.0, 0.6), np.array([[3.0, 4.0, np.nan]] * 3)
    noise = np.array([[9.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 0.0, np.nan]])
    plots = Plots.polar(np.zeros(3), np.full(3, 5.0), np.zeros(3))
    plots = replace(plots, position=place, position_covariance=np.tile(noise, (3, 1, 1)))
    turned = in_sensor_axes(plots, pose, MountConfig(yaw=0.3))
    back = Rotation.from_euler('z', -0.9).as_matrix()[:2, :2]
    np.testing.assert_allclose(turned.position[1, :2], back @ [3.0, 4.0], atol=1e-12)
    np.testing.assert_allclose(
        turned.position_covariance[2, :2, :2], back @ noise[:2, :2] @ back.T, atol=1e-12
    )
    assert np.isnan(turned.position[:, 2]).all()
    assert np.isnan(turned.position_covariance).sum() == 3
    np.testing.assert_allclose(turned.azimuth, -0.9)


def poses(position_covariance, yaw_variance, yaw):
    """Return a platform that is turned by `yaw` at the times of three plots."""
    turn = Rotation.from_euler('z', np.full((3, 1), yaw)).as_quat()
    return PlatformPose(
        position=np.tile([100.0, -50.0, 0.0], (3, 1)),
        orientation=turn,
        velocity=np.zeros((3, 3)),
        position_covariance=np.tile(position_covariance, (3, 1, 1)),
        yaw_variance=np.full(3, yaw_variance),
        turn_rate=np.zeros((3, 3)),
    )


def test_covariance_of_own_ship_is_in_that_of_the_plots():
    """Oracle: the spread of a plot when range, azimuth, place and heading are all drawn anew."""
    rng, draws = np.random.default_rng(2), 200_000
    config = with_values(RadarTrackerConfig(), NOISE).sensor
    radar, place = Radar(config, 2, is_polar=True), np.array([[400.0, 90.0], [90.0, 100.0]])
    full = np.zeros((3, 3))
    full[:2, :2], yaw, yaw_sd = place, 0.7, 0.01
    plots = Plots.polar(np.zeros(3), np.array([3000.0, 900.0, 5000.0]), np.array([0.3, 2.0, -1.0]))
    pose = poses(full, yaw_sd**2, yaw)
    scan = radar.measure(plots, pose, Coverage(0.0, 0.0), 1.0)
    for row in range(3):
        angle = plots.azimuth[row] + AZIMUTH_SD * rng.standard_normal(draws)
        angle += yaw + yaw_sd * rng.standard_normal(draws)
        distance = plots.range[row] + RANGE_SD * rng.standard_normal(draws)
        at = distance * np.stack([np.cos(angle), np.sin(angle)])
        at += rng.multivariate_normal(np.zeros(2), place, draws).T
        spread = np.cov(at)
        # 200,000 draws know a variance to 0.3 %; the rest is the bend of the noise.
        np.testing.assert_allclose(
            scan.covariance[row], spread, rtol=0.03, atol=0.01 * spread.max()
        )
    expected = replace(radar, doubt=PlatformDoubt.of(pose)).noise(
        scan.position, Coverage(0.0, 0.0, sensor_position=(100.0, -50.0, 0.0))
    )
    np.testing.assert_allclose(expected, scan.covariance, rtol=1e-9)


def test_tracks_of_an_unsure_ship_keep_their_plots_and_are_honest():
    """Own ship is off by 100 m anew in each message: no look is lost, no error is hidden."""
    rng = np.random.default_rng(1)
    values = {**NOISE, **QUIET, 'scan.assembly': 'snapshot'}
    config = with_values(RadarTrackerConfig(), values)
    node_config = replace(radar_node_config(), ownship_timeout=3.0)
    radar = radar_session(config, node_config, TYPES, logging.getLogger('own ship'))
    coasted, errors = [], []
    for number in range(150):
        time, where = 1000.0 + PERIOD * number, np.array([0.0, 5.0 * PERIOD * number])
        radar.ownship(odometry(time, where + rng.normal(0.0, 100.0, 2), 0.0, 100.0**2), 0.0)
        offset = BUOYS - where
        columns = {
            'range': np.hypot(*offset.T) + rng.normal(0.0, RANGE_SD, 4),
            'azimuth': np.arctan2(offset[:, 1], offset[:, 0]) + rng.normal(0.0, AZIMUTH_SD, 4),
        }
        table = to_columns(radar.plots(from_columns(columns, time, 'radar', TYPES), 0.0), 100)
        if number < 30:
            continue
        rows = table['status'] == 1
        coasted.append(table['coasted'][rows])
        at, P = np.stack([table['x'], table['y']], axis=1)[rows], table['covariance'][rows]
        apart = at[:, None] - BUOYS
        error = apart[np.arange(len(at)), np.hypot(*apart.T).T.argmin(axis=1)]
        P = P.reshape(-1, 6, 6)[:, :2, :2]
        errors.append(np.einsum('ti,tij,tj->t', error, np.linalg.inv(P), error) / 2.0)
    assert table['id'].max() == len(BUOYS)  # nobody was lost and found again
    assert np.concatenate(coasted).mean() < 0.03  # 13 % with gates for the radar's noise alone
    assert 0.3 < np.concatenate(errors).mean() < 1.5


def test_ordered_track_starts_with_the_noise_of_its_place_before_own_ship():
    """A point 10 km ahead of a ship far from the origin is as sure as a plot there."""
    ship = Platform(
        np.zeros(1), np.array([[50e3, 0.0, 0.0]]), np.array([[0.0, 0.0, 0.0, 1.0]]),
        np.zeros((1, 3)), np.zeros((1, 3, 3)), np.zeros(1), max_extrapolation=1e9,
    )  # fmt: skip
    tracker = RadarTracker(RadarTrackerConfig())
    tracker.track(Plots.polar(np.zeros(1), np.array([5e3]), np.array([1.0])), ship)
    place = np.array([50e3, 10e3, 0.0])
    tracker.start_track(place, 1.0)
    P = tracker.tracks.planes[0].covariance[-1, 0]
    noise = tracker.plot_noise(place[None])[0]
    np.testing.assert_allclose(P[np.ix_([0, 2], [0, 2])], noise, rtol=1e-9)


def test_point_to_track_is_judged_from_own_ship():
    """Far from the origin of the frame, as in a grid of a country: near own ship is near."""
    config = with_values(RadarTrackerConfig(), {'sensor.range_max': 50e3})
    radar = radar_session(config, radar_node_config(), TYPES, logging.getLogger('own ship'))
    for time in (1000.0, 1001.0):
        radar.ownship(odometry(time, (500e3, 5000e3), 0.0), 0.0)
    columns = {'range': np.array([9e3]), 'azimuth': np.array([1.0])}
    radar.plots(from_columns(columns, 1001.0, 'radar', TYPES), 0.0)
    for ahead in (10e3, 60e3):
        point = TYPES.Point(x=500e3 + ahead, y=5000e3, z=0.0)
        acquire(radar, SimpleNamespace(header=TYPES.header(1001.0, 'odom'), point=point))
    assert len(radar.tracks) == 1
    assert radar.counts['acquire'].refused['bad point'] == 1
