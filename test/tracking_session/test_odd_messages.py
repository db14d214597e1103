# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does one odd message leave behind? Nothing that the next ones do not put right."""

import logging

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.config import with_values
from tracking_core.platform import Platform
from tracking_session.whereabouts import NotYet

TYPES = rosbags_types()
PERIOD, SPEED = 4.0, 5.0  # of the antenna [s], of own ship [m/s]


def radar(**node_values):
    """Return a session of a radar."""
    node = with_values(radar_node_config(), node_values)
    return radar_session(RadarTrackerConfig(), node, TYPES, logging.getLogger('odd'))


def odometry(time, covariance=None):
    """Return own ship, which sails straight on."""
    zero = TYPES.Vector3(x=0.0, y=0.0, z=0.0)
    pose = TYPES.Pose(
        position=TYPES.Point(x=SPEED * time, y=0.0, z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
    )
    twist = TYPES.Twist(linear=TYPES.Vector3(x=SPEED, y=0.0, z=0.0), angular=zero)
    told = np.zeros(36) if covariance is None else covariance
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'),
        child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=told),
        twist=TYPES.TwistWithCovariance(twist=twist, covariance=np.zeros(36)),
    )


def turn(time, frame='radar'):
    """Return the plots of three contacts at rest."""
    place = np.array([[20e3, 10e3], [-30e3, 5e3], [10e3, -40e3]]) - [SPEED * time, 0.0]
    columns = {'range': np.hypot(*place.T), 'azimuth': np.arctan2(*place.T[::-1])}
    return from_columns(columns, time, frame, TYPES)


def test_first_plots_that_are_refused_do_not_decide_the_frame():
    """Of another sensor, at a time when nobody knows where own ship was; then ours come."""
    session = radar()
    for time in np.arange(0.0, 20.0, 0.5):
        session.ownship(odometry(time), 0.0)
    assert session.plots(turn(500.0, 'other'), 0.0) is None
    assert session.plots(turn(4.0), 0.0) is not None
    assert session.plots(turn(8.0, 'other'), 0.0) is None
    assert session.counts['plots'].refused == {'own ship stale': 1, 'wrong frame': 1}


def test_first_plots_without_a_transform_do_not_decide_the_frame():
    """tf2 knows nothing of the frame that they are told in; then ours come."""

    class Transforms:
        """Know one sensor, which is at rest."""

        def sensor(self, frame, into, times):
            if frame != 'radar':
                raise NotYet(f'no transform from {frame} to {into}')
            return Platform(
                times[:1], np.zeros((1, 3)), np.array([[0.0, 0.0, 0.0, 1.0]]), np.zeros((1, 3)),
                np.zeros((1, 3, 3)), np.zeros(1),
            )  # fmt: skip

    session = radar(tracking_frame='map')
    session.use_transforms(Transforms())
    with pytest.raises(NotYet):
        session.plots(turn(0.0, 'other'), 0.0, patience=1.0)
    assert session.plots(turn(PERIOD), 0.0) is not None


def matrix(place, value):
    """Return the covariance of a pose with this value in one place, and on the other side."""
    covariance = np.zeros((6, 6))
    covariance[place] = covariance[place[::-1]] = value
    return covariance.ravel()


@pytest.mark.parametrize(
    ('place', 'value'),
    [
        ((0, 1), 1e4), ((0, 1), 1e300), ((1, 2), 1e6), ((0, 0), 1e20), ((2, 2), 1e300),
        ((5, 5), 1e20), ((5, 5), 1e300),
    ],
)  # fmt: skip
@pytest.mark.filterwarnings('error')
def test_one_covariance_of_own_ship_that_cannot_be_true_costs_no_track(place, value):
    """It is that of no position, or of one that is nowhere: the plots of this turn count."""
    session, odd = radar(), matrix(place, value)
    for number in range(12):
        for part in range(8):
            time = PERIOD * number + 0.5 * part
            session.ownship(odometry(time, odd if (number, part) == (8, 0) else None), 0.0)
        session.plots(turn(PERIOD * number), 0.0)
    assert session.tracks.id.tolist() == [1, 2, 3]
    assert session.tracks.hits.tolist() == [12, 12, 12]
    assert np.isfinite(session.instrument.tracker.state.clutter.density)


def test_heading_that_nobody_knows_costs_no_track_and_is_told_once(caplog):
    """As of a receiver that tells 1e5 rad^2: the true directions of the plots need none."""
    session = radar()
    with caplog.at_level(logging.WARNING):
        for number in range(12):
            for part in range(8):
                session.ownship(odometry(PERIOD * number + 0.5 * part, matrix((5, 5), 1e5)), 0.0)
            session.plots(turn(PERIOD * number), 0.0)
    assert session.tracks.id[session.tracks.confirmed].tolist() == [1, 2, 3]
    assert len([r for r in caplog.records if 'that of no heading' in r.message]) == 1
    assert session.counts['ownship'].doubtful == {'variance of the heading': 96}
