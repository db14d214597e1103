# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a stamp means does not matter where plots tell their times."""

import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session

pytest.importorskip('rosbags')
TYPES = pytest.importorskip('msg_adapters.message_types').rosbags_types()


def odometry(time):
    """Return own ship at rest."""
    zero, covariance = TYPES.Vector3(x=0.0, y=0.0, z=0.0), np.zeros(36)
    pose = TYPES.Pose(
        position=TYPES.Point(x=0.0, y=0.0, z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
    )
    twist = TYPES.Twist(linear=zero, angular=zero)
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'), child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=covariance),
        twist=TYPES.TwistWithCovariance(twist=twist, covariance=covariance),
    )  # fmt: skip


@pytest.mark.parametrize('has_own_ship', [False, True])
def test_stamps_at_the_end_of_a_turn_need_no_parameter_where_plots_tell_times(has_own_ship):
    """Contacts at rest are all held, and no message asks where own ship will be."""
    log = logging.getLogger('stamps')
    radar = radar_session(RadarTrackerConfig(), radar_node_config(), TYPES, log)
    part = np.array([0.05, 0.15, 0.3, 0.45, 0.7, 0.8, 0.9, 0.95])
    columns = {'time': 4.0 * (part - 1.0), 'range': np.full(8, 2e4), 'azimuth': 6.2832 * part}
    for end in np.arange(1004.0, 1084.0, 4.0):
        for time in np.arange(end - 4.0, end, 0.5) if has_own_ship else []:
            radar.ownship(odometry(time), time)
        radar.plots(from_columns(columns, end, 'radar', TYPES), end)
        assert (radar.tracks.misses == 0).all()
    assert radar.tracks.id.tolist() == list(range(1, 9))
    assert radar.tracks.confirmed.all()
    assert not radar.counts['plots'].refused
