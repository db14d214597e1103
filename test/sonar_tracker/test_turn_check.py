# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Bearings that are not counted as the parameters say are told when own ship turns."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_core.config import with_values

pytest.importorskip('rosbags')
message_types = pytest.importorskip('msg_adapters.message_types')
TYPES = message_types.rosbags_types()
DEGREE = np.pi / 180.0
PERIOD, CYCLES, RATE = 2.0, 60, 1.0 * DEGREE  # [s], [rad/s]
CONTACTS = np.array([-170.0, -60.0, 10.0, 95.0]) * DEGREE
MIRRORED, TRUE = 'set sensor.azimuth_convention', 'set sensor.azimuth_reference to tracking_frame'
RELATIVE = 'set sensor.azimuth_reference to frame'


def heading(time: float) -> float:
    """Return that of own ship, which turns by 60 degrees after half a minute."""
    return 0.3 + RATE * float(np.clip(time - 30.0, 0.0, 60.0))


def odometry(time: float):
    """Return own ship, which goes nowhere: how it heads is all that counts."""
    zero, half = TYPES.Vector3(x=0.0, y=0.0, z=0.0), 0.5 * heading(time)
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=np.sin(half), w=np.cos(half))
    place = TYPES.Point(x=0.0, y=0.0, z=0.0)
    return TYPES.Odometry(
        header=TYPES.header(1000.0 + time, 'odom'),
        child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(
            pose=TYPES.Pose(position=place, orientation=turn), covariance=np.zeros(36)
        ),
        twist=TYPES.TwistWithCovariance(
            twist=TYPES.Twist(linear=zero, angular=zero), covariance=np.zeros(36)
        ),
    )


def said(bearings, strays=1.0, **values) -> str:
    """Return what is doubted of bearings (M,) that contacts (M,) are told at under a heading."""
    rng = np.random.default_rng(2)
    config = with_values(SonarTrackerConfig(), {'sensor.bearing_sd': 0.5 * DEGREE, **values})
    sonar = sonar_session(config, sonar_node_config(), TYPES, logging.getLogger('session'))
    for time in (PERIOD * np.arange(CYCLES)).tolist():
        sonar.ownship(odometry(time), 0.0)
        heard = CONTACTS[rng.random(len(CONTACTS)) < 0.8]
        told = bearings(heard, heading(time)) + 0.5 * DEGREE * rng.standard_normal(len(heard))
        told = np.append(told, rng.uniform(-np.pi, np.pi, rng.poisson(strays)))
        bearing = np.angle(np.exp(1j * told))
        sonar.plots(from_columns({'bearing': bearing}, 1000.0 + time, 'sonar', TYPES), 0.0)
    return ' '.join(doubt.text for doubt in sonar.instrument.doubts())


@pytest.mark.parametrize(
    ('bearings', 'values', 'words'),
    [
        (lambda true, yaw: true - yaw, {}, ''),
        (lambda true, yaw: yaw - true, {'sensor.azimuth_convention': 'clockwise'}, ''),
        (lambda true, yaw: true, {'sensor.azimuth_reference': 'tracking_frame'}, ''),
        (lambda true, yaw: yaw - true, {}, MIRRORED),
        (lambda true, yaw: true - yaw, {'sensor.azimuth_convention': 'clockwise'}, MIRRORED),
        (lambda true, yaw: true, {}, TRUE),
        (lambda true, yaw: np.pi / 2 - true, {'sensor.azimuth_convention': 'clockwise'}, TRUE),
        (lambda true, yaw: true - yaw, {'sensor.azimuth_reference': 'tracking_frame'}, RELATIVE),
    ],
)
def test_bearings_counted_otherwise_are_said_and_how_to_set_it(bearings, values, words) -> None:
    """Head-up, north-up and clockwise ones, each taken for another; nothing if all is right."""
    text = said(bearings, **values)
    assert (words in text) if words else not text


@pytest.mark.parametrize('strays', [1.0, 2.0])
def test_false_marks_hide_nothing(strays) -> None:
    """Some fit by chance; those of contacts always do."""
    assert MIRRORED in said(lambda true, yaw: yaw - true, strays)
    assert not said(lambda true, yaw: true - yaw, strays)


def test_a_linear_array_may_have_its_contacts_on_the_other_side() -> None:
    """Counted to starboard, those to port turn twice as far: it may be that."""
    values = {'sensor.array': 'linear'}
    assert 'set sensor.both_sides' in said(lambda true, yaw: yaw - true, **values)
