# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship whose path is not what its heading and twist say is told so; others are not."""

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.ownship import to_platform
from tracking_session.twist_check import SPAN, TwistCheck

TYPES = rosbags_types()
SPEED, RATE = 8.0, 0.03  # m/s, rad/s


def odometry(time, told, noise=0.0, sd=0.0):
    """Return a ship that turns to port; heading and twist are told right, or so."""
    yaw = 0.6 + RATE * time
    place = SPEED / RATE * np.array([np.sin(yaw), -np.cos(yaw)])
    x, y = place + noise * np.random.default_rng(round(10 * time)).standard_normal(2)
    forward, left = {
        'twist of the map': (SPEED * np.cos(yaw), SPEED * np.sin(yaw)), 'no twist': (0.0, 0.0)
    }.get(told, (SPEED, 0.0))  # fmt: skip
    half = 0.5 * (0.5 * np.pi - yaw if told == 'heading from north' else yaw)
    pose = TYPES.Pose(
        position=TYPES.Point(x=float(x), y=float(y), z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=np.sin(half), w=np.cos(half)),
    )
    zero = TYPES.Vector3(x=0.0, y=0.0, z=0.0)
    linear = TYPES.Vector3(x=float(forward), y=float(left), z=0.0)
    return to_platform(
        TYPES.Odometry(
            header=TYPES.header(time, 'odom'), child_frame_id='base_link',
            pose=TYPES.PoseWithCovariance(pose=pose, covariance=sd**2 * np.eye(6).ravel()),
            twist=TYPES.TwistWithCovariance(
                twist=TYPES.Twist(linear=linear, angular=zero), covariance=np.zeros(36)
            ),
        )
    )  # fmt: skip


def doubts_of(told, rate=10.0, duration=200.0, **how):
    """Return what is said after so long [s] of samples at a rate [Hz], by span."""
    check, said = TwistCheck(memory=2.5), []
    for time in np.arange(0.0, duration, 1.0 / rate):
        check.take(odometry(float(time), told, **how))
        said.append(next((doubt.text for doubt in check.doubts()), ''))
    return said


@pytest.mark.parametrize('rate', [0.5, 1.0, 10.0])
@pytest.mark.parametrize('noise', [0.0, 2.0])
def test_ship_that_moves_as_it_says_is_not_doubted(rate, noise):
    """With the noise of a receiver, told or not, and at any rate."""
    assert not any(doubts_of('right', rate, duration=1000.0, noise=noise))


@pytest.mark.parametrize(
    ('told', 'words'),
    [
        ('twist of the map', '7.9 m/s at -'), ('no twist', '0.0 m/s: twist.twist.linear must'),
        ('heading from north', '8.0 m/s at '),
    ],
)  # fmt: skip
def test_wrong_twists_and_headings_are_told(told, words):
    """Within a minute; each is usual where REP 103 and 105 are not read."""
    said = doubts_of(told, duration=60.0)
    assert not any(said[: int(30.0 * SPAN)])  # at 10 Hz, three spans
    assert 'own ship moves by 8.0 m/s at ' in said[-1]
    assert f'by its heading and twist it should by {words}' in said[-1]


def test_ship_that_does_not_know_its_place_is_not_doubted():
    """Off by 100 m anew in each message, and says so."""
    assert not any(doubts_of('no twist', duration=300.0, noise=100.0, sd=100.0))
    assert any(doubts_of('no twist', duration=300.0, noise=100.0))


def test_silence_ends_a_span_and_a_reset_all_of_them():
    """What own ship did meanwhile nobody told; doubts are of spans in a row."""
    check = TwistCheck(memory=2.5)
    for time in np.arange(0.0, 200.0, 0.5):
        if time % 8.0 < 4.0:
            check.take(odometry(float(time), 'no twist'))
    assert not list(check.doubts())
    for time in np.arange(200.0, 250.0, 0.5):
        check.take(odometry(float(time), 'no twist'))
    assert list(check.doubts())
    check.reset()
    check.take(odometry(300.0, 'no twist'))
    assert not list(check.doubts())
