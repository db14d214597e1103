# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Covariances that messages give for positions reach the measurement, if they are covariances."""

import logging

from geometry_msgs.msg import PoseWithCovarianceStamped
from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from msg_adapters.fields import COVARIANCE
from msg_adapters.message_types import rclpy_types
from msg_adapters.plots import to_plots
from msg_adapters.position_noise import position_covariance
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import SensorConfig
from radar_tracker.session import radar_session
from tracking_core.batches import Coverage
from tracking_core.platform import pose_at

LONG = np.array([[400.0, 90.0, 0.0], [90.0, 25.0, 0.0], [0.0, 0.0, 9.0]])


def pose(covariance, stamp=100.0, x=5000.0):
    """Return a pose with the covariance (3, 3) of its position."""
    msg = PoseWithCovarianceStamped(header=rclpy_types().header(stamp, 'radar'))
    msg.pose.pose.position.x = x
    full = np.zeros((6, 6))
    full[:3, :3] = covariance
    msg.pose.covariance = full.ravel()
    return msg


def measured(msg):
    """Return the covariances (M, 3, 3) with which the plots of a message are used."""
    plots = to_plots(msg, SensorConfig(), 9).plots
    radar = Radar.for_plots(SensorConfig(dimensions=3), plots)
    coverage = Coverage(0.0, 100.0)
    return radar.measure(plots, pose_at(None, plots.time), coverage, 1.0).covariance


def test_covariance_of_a_pose_is_that_of_the_measurement():
    """Element by element, in the axes of the message."""
    np.testing.assert_allclose(measured(pose(LONG))[0], LONG)


@pytest.mark.parametrize(
    'covariance',
    [np.zeros((3, 3)), np.diag([-1.0, 0.0, 0.0]), np.full((3, 3), np.nan), np.full((3, 3), 4.0),
     np.diag([1e300, 1e300, 1.0]), LONG * [[1, 9, 1], [9, 1, 1], [1, 1, 1]]],
    ids=['zero', 'unknown', 'nan', 'singular', 'huge', 'not positive'],
)  # fmt: skip
def test_what_is_no_covariance_leaves_the_noise_of_the_parameter(covariance):
    """`sensor.position_sd` stands in."""
    sd = SensorConfig().position_sd
    np.testing.assert_allclose(measured(pose(covariance))[0], sd**2 * np.eye(3))


def test_unknown_height_leaves_x_and_y():
    """A covariance with 0 for z says how sure the place on the map is."""
    flat = LONG * [[1, 1, 0], [1, 1, 0], [0, 0, 0]]
    got = measured(pose(flat))[0]
    np.testing.assert_allclose(got[:2, :2], LONG[:2, :2])
    np.testing.assert_allclose(got[2], [0.0, 0.0, SensorConfig().position_sd ** 2])


def test_columns_of_a_table_say_the_same(types):
    """`x_sd` and its synonyms, or the elements of a covariance, row by row."""
    columns = {
        'x': np.ones(2), 'y': np.ones(2), 'x_std': np.array([3.0, 4.0]),
        'sigma_y': np.array([5.0, np.nan]), 'covariance_xy': np.array([2.0, 0.0]),
    }  # fmt: skip
    plots = to_plots(from_columns(columns, 1.0, 'radar', types), SensorConfig(), 9).plots
    np.testing.assert_allclose(plots.position_covariance[0, :2, :2], [[9.0, 2.0], [2.0, 25.0]])
    assert np.isnan(plots.position_covariance[1]).all()


def test_position_covariance_counts_what_is_none():
    """Zeros say nothing; a negative variance is a mistake."""
    read = {
        'covariance_xx': np.array([0.0, -1.0, 4.0]),
        'covariance_yy': np.array([0.0, 1.0, 4.0]),
    }
    covariance, odd = position_covariance(read, 3)
    assert odd == 1
    np.testing.assert_array_equal(np.isfinite(covariance[:, 0, 0]), [False, False, True])


def test_track_is_as_sure_as_the_poses_say():
    """Along x 20 m, across 5 m: the track's ellipse lies the same way."""
    log, node = logging.getLogger('test'), radar_node_config()
    session = radar_session(RadarTrackerConfig(), node, rclpy_types(), log)
    for step in range(8):
        stamp = 100.0 + step
        session.plots(pose(np.diag([400.0, 25.0, 9.0]), stamp, 5000.0 + 50.0 * step), stamp)
    _, covariance = session.tracks.planes[0].moments()
    assert 9.0 < covariance[0, 0, 0] / covariance[0, 2, 2] < 20.0  # 16 without process noise


@settings(max_examples=200)
@given(st.lists(st.floats(), min_size=9, max_size=9))
def test_any_numbers_give_a_covariance_or_none(values):
    """Whatever a message holds: positive definite where it is told, and no warning."""
    names = [*COVARIANCE, 'x_sd', 'y_sd', 'z_sd']
    read = {name: np.array([value]) for name, value in zip(names, values, strict=True)}
    covariance, odd = position_covariance(read, 1)
    told = covariance[0][: 2 + bool(np.isfinite(covariance[0, 2, 2]))]
    told = told[:, : len(told)]
    assert np.isnan(told).all() or np.all(np.linalg.eigvalsh(told) > 0.0)
    assert odd in (0, 1)
