# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship that is suddenly elsewhere: once is refused, for good begins anew."""

from dataclasses import replace
import logging

import numpy as np

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.config import with_values
from tracking_core.platform import Platform

TYPES = rosbags_types()
PERIOD, SPEED, LEAP = 4.0, 10.0, 1000.0  # s, m/s of own ship, m
CONTACTS = np.array([[20e3, 10e3], [-30e3, 15e3], [5e3, -25e3]])


def odometry(time, leap):
    """Return what a ship says that sails to the east."""
    zero, covariance = TYPES.Vector3(x=0.0, y=0.0, z=0.0), np.zeros(36)
    pose = TYPES.Pose(
        position=TYPES.Point(x=SPEED * time + leap, y=0.0, z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
    )
    twist = TYPES.Twist(linear=TYPES.Vector3(x=SPEED, y=0.0, z=0.0), angular=zero)
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'), child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=covariance),
        twist=TYPES.TwistWithCovariance(twist=twist, covariance=covariance),
    )  # fmt: skip


def sail(radar, numbers, leap=0.0, ahead=0.0):
    """Feed odometry, so far ahead, and plots of contacts at rest; return tracks of each scan."""
    tables = []
    for number in numbers:
        time = PERIOD * number
        radar.ownship(odometry(time + ahead, leap), time)
        seen = CONTACTS - [SPEED * time, 0.0]
        noise = np.random.default_rng(number).normal(0.0, 1.0, (2, 3))
        columns = {
            'range': np.hypot(*seen.T) + 20.0 * noise[0],
            'azimuth': np.arctan2(seen[:, 1], seen[:, 0]) + 1e-4 * noise[1],
        }
        table = radar.plots(from_columns(columns, time, 'radar', TYPES), time)
        tables += [] if table is None else [to_columns(table, 100)]
    return [set(t['id'][t['status'] == 1].tolist()) for t in tables], tables[-1]


def make(log='leaps'):
    """Return a radar on a ship."""
    config = replace(radar_node_config(), ownship_timeout=10.0)
    return radar_session(RadarTrackerConfig(), config, TYPES, logging.getLogger(log))


def test_one_leap_of_own_ship_moves_no_track():
    """The place is refused and counted; ids and places stay."""
    radar = make()
    before = sail(radar, range(10))[0][-1]
    sail(radar, [10], LEAP)
    ids, table = sail(radar, range(11, 15))
    assert len(before) == 3
    assert all(now == before for now in ids)
    assert radar.counts['ownship'].refused == {'own ship leaps': 1}
    off = np.hypot(table['x'][:, None] - CONTACTS[:, 0], table['y'][:, None] - CONTACTS[:, 1])
    assert off.min(axis=1).max() < 60.0  # 20 m and 2 to 3 m of noise, three sd


def test_leap_for_good_begins_anew(caplog):
    """Two places are refused, the third is believed, with one warning; then tracks come back."""
    radar = make('leaps for good')
    before = sail(radar, range(10))[0][-1]
    with caplog.at_level(logging.WARNING):
        ids, _ = sail(radar, range(10, 20), LEAP)
    assert radar.counts['ownship'].refused == {'own ship leaps': 2}
    assert len([r for r in caplog.records if 'own ship is elsewhere' in r.message]) == 1
    assert len(ids[-1]) == 3
    assert not ids[-1] & before


def test_plots_from_before_a_leap_bring_no_old_track_back():
    """They come late, when tracking has begun anew: what was forgotten stays so."""
    config = replace(radar_node_config(), ownship_timeout=10.0)
    config = with_values(config, {'scan.late': 5})
    log = logging.getLogger('late and leaps')
    radar = radar_session(RadarTrackerConfig(), config, TYPES, log)
    before = sail(radar, range(10))[0][-1]
    sail(radar, [10, 11, 12], LEAP)
    assert not set(radar.tracks.id.tolist()) & before
    columns = {'range': np.array([15e3]), 'azimuth': np.array([0.3])}
    assert radar.plots(from_columns(columns, 10.5 * PERIOD, 'radar', TYPES), 60.0) is None
    assert not set(radar.tracks.id.tolist()) & before


def test_leap_is_not_sailed_through():
    """Plots of just before the first place that is believed were not seen from between the two."""
    radar = make()
    sail(radar, range(10))
    for number in (10, 11, 12):
        radar.ownship(odometry(PERIOD * number, LEAP), 0.0)
    for time in (46.0, 48.0):  # s; the last of the old places is of 36, the new one of 48
        seen = CONTACTS - [SPEED * time + LEAP, 0.0]
        columns = {'range': np.hypot(*seen.T), 'azimuth': np.arctan2(seen[:, 1], seen[:, 0])}
        table = to_columns(radar.plots(from_columns(columns, time, 'radar', TYPES), 0.0), 100)
    started = table['status'] == 0
    assert started.sum() == 3
    assert table['speed'][started].max() < 1.0


def test_recording_that_begins_anew_brings_its_own_path():
    """The old one, elsewhere at the same times, is forgotten, and no place is called a leap."""
    radar = make()
    sail(radar, range(40))
    ids, table = sail(radar, range(20), LEAP, ahead=0.5 * PERIOD)
    assert len(ids[-1]) == 3
    places, confirmed = CONTACTS + np.array([LEAP, 0.0]), table['status'] == 1
    off = np.hypot(table['x'][:, None] - places[:, 0], table['y'][:, None] - places[:, 1])
    assert off[confirmed].min(axis=0).max() < 60.0
    assert set(radar.counts['ownship'].refused) == {'stamp behind time'}


class Tree:
    """Transforms of the same ship, as a tree tells them every second, and 0.2 s before."""

    leap = 0.0

    def sensor(self, frame, into, times):
        """Return the path from the first to the last time."""
        time = np.append(times.min() - 0.2, np.arange(times.min(), times.max() + 1e-6, 1.0))
        place = np.zeros((len(time), 3))
        place[:, 0] = SPEED * time + self.leap
        level = np.tile([0.0, 0.0, 0.0, 1.0], (len(time), 1))
        velocity = np.tile([SPEED, 0.0, 0.0], (len(time), 1))
        sure = np.zeros((len(time), 3, 3)), np.zeros(len(time))
        return Platform(time, place, level, velocity, *sure)


def test_leap_of_the_tree_begins_anew(caplog):
    """As a map that is corrected: said once, and no old track stays where nobody is."""
    config = replace(radar_node_config(), use_tf=True, tracking_frame='odom')
    log, tree = logging.getLogger('leaps of the tree'), Tree()
    radar = radar_session(RadarTrackerConfig(), config, TYPES, log)
    radar.use_transforms(tree)
    before = by_tree(radar, range(10))[-1]
    assert len(before) == 3
    tree.leap = LEAP
    with caplog.at_level(logging.WARNING):
        ids = by_tree(radar, range(10, 20))
    assert len([r for r in caplog.records if 'the sensor is elsewhere' in r.message]) == 1
    assert not set().union(*ids) & before
    assert len(ids[-1]) == 3


def by_tree(radar, numbers):
    """Feed plots of a turn, of which the transforms tell three seconds; return confirmed ids."""
    ids = []
    for number in numbers:
        seen = CONTACTS - [SPEED * (PERIOD * number + 1.5), 0.0]
        columns = {
            'range': np.hypot(*seen.T), 'azimuth': np.arctan2(seen[:, 1], seen[:, 0]),
            'time': np.array([0.0, 1.0, 3.0]),
        }  # fmt: skip
        table = radar.plots(from_columns(columns, PERIOD * number, 'radar', TYPES), 0.0)
        rows = to_columns(table, 100)
        ids.append(set(rows['id'][rows['status'] == 1].tolist()))
    return ids
