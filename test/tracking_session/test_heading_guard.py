# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A compass that is reset is told; ships that yaw and boats that turn hard are not."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.platform import Platform
from tracking_session.heading_guard import HeadingGuard

TYPES = rosbags_types()
RESET = 38.5  # s


def straight(time):
    """Return the heading [degrees] of a ship that holds its course."""
    return 20.0


def yawing(time):
    """Return that of one that yaws by 3 degrees to either side in 6 s."""
    return 3.0 * np.sin(2.0 * np.pi * time / 6.0)


def hard_over(time):
    """Return that of a boat that turns by 90 degrees in 3 s, as fast at once, now and then."""
    return 90.0 * (time // 13.0) + np.clip(30.0 * (time % 13.0 - 5.0), 0.0, 90.0)


def said(path, rate, leap=0.0, duration=70.0, noise=0.0, held=0.0):
    """Return what is said of headings at a rate [Hz] with noise [degrees], new ones held [s]."""
    guard, rng, words = HeadingGuard(), np.random.default_rng(1), []
    for time in np.arange(0.0, duration, 1.0 / rate):
        then = time // held * held if held else time
        off = rng.normal() if not held else np.random.default_rng(round(10 * then)).normal()
        yaw = np.radians(path(then) + noise * off + leap * (then >= RESET))
        orientation = np.array([[0.0, 0.0, np.sin(0.5 * yaw), np.cos(0.5 * yaw)]])
        none = np.zeros((1, 3))
        sample = Platform(
            np.array([time]), none, orientation, none, np.zeros((1, 3, 3)), np.zeros(1)
        )
        guard.take(sample, lambda what, text: words.append(text))
    return words


@pytest.mark.parametrize('path', [straight, yawing, hard_over])
@pytest.mark.parametrize('leap', [10.0, -45.0, 170.0])
def test_compass_that_is_reset_is_told(path, leap):
    """Once, with field and value, also where the ship yaws; the boat is between two turns."""
    (words,) = said(path, 10.0, leap)
    assert words.startswith(f'by {leap:.0f} degrees in 0.1 s, from ')
    assert 'pose.pose.orientation' in words


@pytest.mark.parametrize('path', [straight, yawing, hard_over])
@pytest.mark.parametrize('rate', [0.5, 1.0, 2.0, 10.0, 50.0])
@pytest.mark.parametrize('noise', [0.0, 0.5, 2.0])
def test_ships_that_turn_are_not_told(path, rate, noise):
    """At any rate, with the noise of a compass."""
    assert not said(path, rate, noise=noise, duration=200.0 if rate < 50.0 else 50.0)


def test_headings_told_many_times_are_no_leaps():
    """A new one a second, ten odometries a second: a boat that turns seems to leap each second."""
    assert not said(hard_over, 10.0, duration=200.0, noise=0.3, held=1.0)


def odometry(time, degrees):
    """Return own ship at rest with this heading."""
    zero, half = TYPES.Vector3(x=0.0, y=0.0, z=0.0), 0.5 * np.radians(degrees)
    pose = TYPES.Pose(
        position=TYPES.Point(x=0.0, y=0.0, z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=np.sin(half), w=np.cos(half)),
    )
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'), child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
        twist=TYPES.TwistWithCovariance(
            twist=TYPES.Twist(linear=zero, angular=zero), covariance=np.zeros(36)
        ),
    )  # fmt: skip


def test_session_says_and_counts_a_heading_that_leaps(caplog):
    """In the log once, and among what the diagnostics warn of."""
    radar = radar_session(
        RadarTrackerConfig(), radar_node_config(), TYPES, logging.getLogger('heading')
    )
    with caplog.at_level(logging.WARNING):
        for time in np.arange(0.0, 45.0, 0.1):
            radar.ownship(odometry(float(time), 10.0 * (time >= RESET)), float(time))
    (line,) = [record.message for record in caplog.records]
    assert line.startswith("own ship's heading leaps: by 10 degrees in 0.1 s, from 0 to 10")
    assert radar.ledger.failures == {"own ship's heading leaps": 1}
