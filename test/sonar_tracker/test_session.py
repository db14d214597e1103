# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What happens to a sonar's messages without a ROS graph: good ones track, bad ones do not."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns, to_columns
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_core.config import with_values

pytest.importorskip('rosbags')
message_types = pytest.importorskip('msg_adapters.message_types')
TYPES = message_types.rosbags_types()
PERIOD = 2.0
DEGREE = np.pi / 180.0
ODD = [np.nan, np.inf, -np.inf, -1.0, 0.0, 1e-300, 1e30, 1e300, 7.0, 500.0]
VALUES = {'sensor.bearing_sd': 0.3 * DEGREE, 'initiation.rate_sd': 0.02 * DEGREE}
SPEED = 5.0  # of own ship, to the north [m/s]


def session(values=None, **changes):
    """Return a session with few parameters changed."""
    config = with_values(SonarTrackerConfig(), {**VALUES, **(values or {})})
    node_config = replace(sonar_node_config(), **changes)
    return sonar_session(config, node_config, TYPES, logging.getLogger('session'))


def true_bearings(number):
    """Return where five contacts truly are [rad]."""
    return (np.array([-175.0, -60.0, 10.0, 95.0, 179.0]) + 0.02 * number) * DEGREE


def cycle(number, turned=0.0, frame='sonar'):
    """Return the marks of five contacts, seen by a sonar that is turned."""
    rng = np.random.default_rng(number)
    bearing = true_bearings(number) - turned + 0.2 * DEGREE * rng.standard_normal(5)
    return from_columns({'bearing': bearing}, 1000.0 + PERIOD * number, frame, TYPES)


def odometry(number):
    """Return own ship, which heads north."""
    time, zero = 1000.0 + PERIOD * number, TYPES.Vector3(x=0.0, y=0.0, z=0.0)
    place = TYPES.Point(x=0.0, y=SPEED * PERIOD * number, z=0.0)
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=np.sqrt(0.5), w=np.sqrt(0.5))
    twist = TYPES.Twist(linear=TYPES.Vector3(x=SPEED, y=0.0, z=0.0), angular=zero)
    return TYPES.Odometry(
        header=TYPES.header(time, 'odom'),
        child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(
            pose=TYPES.Pose(position=place, orientation=turn), covariance=np.zeros(36)
        ),
        twist=TYPES.TwistWithCovariance(twist=twist, covariance=np.zeros(36)),
    )


def follow(sonar, numbers):
    """Feed cycles; return the ids of the confirmed tracks in the last table."""
    for number in numbers:
        columns = to_columns(sonar.plots(cycle(number), 0.0), 10_000)
    return set(columns['id'][columns['status'] == 1].tolist())


def hostile(rng, stamp):
    """Return a message with odd names, values, rows, stamp and frame."""
    names = rng.choice(
        ['bearing', 'azimuth', 'bearing_sd', 'snr', 'time', 't', 'x', 'range'],
        rng.integers(1, 7), replace=False,
    )  # fmt: skip
    columns = {str(name): rng.choice(ODD, rng.integers(0, 6)) for name in names[:1]}
    rows = len(next(iter(columns.values())))
    columns |= {str(name): rng.choice(ODD, rows) for name in names[1:]}
    wrong = stamp + rng.choice([1e9, -1e9, 3600.0, -3600.0, -PERIOD - 1.0, -PERIOD])
    return from_columns(columns, wrong, str(rng.choice(['sonar', '', 'other'])), TYPES)


@pytest.mark.parametrize('seed', range(5))
def test_hostile_messages_between_cycles_change_nothing(seed):
    """All five tracks live through sixty cycles with a bad message before each."""
    rng, sonar = np.random.default_rng(seed), session()
    before = follow(sonar, range(15))
    assert len(before) == 5
    for number in range(15, 75):
        sonar.plots(hostile(rng, 1000.0 + PERIOD * number), 0.0)
        after = follow(sonar, [number])
    assert after == before


def test_odd_rows_within_good_cycles_never_raise():
    """Rows of odd values are dropped or tracked, but nothing breaks."""
    rng, sonar = np.random.default_rng(1), session()
    for number in range(60):
        columns = {
            name: rng.choice([*ODD, 0.1, 1.0, 3.1], 200)
            for name in ('bearing', 'bearing_sd', 'snr', 'time')
        }
        msg = from_columns(columns, 1000.0 + PERIOD * number, 'sonar', TYPES)
        assert sonar.plots(msg, 0.0) is not None  # some of the rows are good


@pytest.mark.parametrize('mount', [0.0, 0.5])
def test_true_bearings_and_relative_ones_give_the_same_tracks(mount):
    """Marks in own ship's frame, or said to be true, are not turned by its heading again."""
    tables = {}
    for frame, turned, told in (
        ('sonar', 0.5 * np.pi + mount, 'relative'), ('odom', 0.0, 'true'), ('sonar', 0.0, 'said'),
    ):  # fmt: skip
        reference = 'tracking_frame' if told == 'said' else 'frame'
        values = {'sensor.mount.yaw': mount, 'sensor.azimuth_reference': reference}
        sonar = session(values, ownship_timeout=5.0)
        for number in range(20):
            sonar.ownship(odometry(number), 0.0)
            table = to_columns(sonar.plots(cycle(number, turned, frame), 0.0), 100)
        tables[told] = table
    relative, true = tables['relative'], tables['true']
    np.testing.assert_array_equal(true['bearing'], tables['said']['bearing'])
    assert np.sum(true['status'] == 1) == 5
    np.testing.assert_array_equal(relative['id'], true['id'])
    apart = np.angle(np.exp(1j * (relative['bearing'] - true['bearing'])))
    np.testing.assert_allclose(apart, 0.0, atol=1e-6)
    off = np.angle(np.exp(1j * (true['bearing'][:, None] - true_bearings(19))))
    assert np.abs(off).min(axis=1).max() < 0.5 * DEGREE


def test_bearings_without_own_ship_at_their_time_are_refused():
    """They would be turned by nobody knows what."""
    sonar = session(ownship_timeout=1.0)
    sonar.ownship(odometry(0), 0.0)
    assert sonar.plots(cycle(0), 0.0) is not None
    assert sonar.plots(cycle(5), 0.0) is None
    assert sonar.counts['bearings'].refused['own ship stale'] == 1


def test_same_messages_give_the_same_bytes():
    """Nothing depends on when or how often it runs."""
    tables = [
        [bytes(sonar.plots(cycle(n), 0.0).data) for n in range(15)]
        for sonar in (session(), session())
    ]
    assert tables[0] == tables[1]


def test_what_a_pause_ends_is_told(caplog):
    """A pause that is shorter than a cycle ends all tracks in every cycle: the log says why."""
    sonar = session({'longest_pause': 0.5 * PERIOD})
    for number in range(6):
        sonar.plots(cycle(number), PERIOD * number)
    assert not sonar.tracks.confirmed.any()
    assert '5 tracks and first plots end: no look for more than 1 s (longest_pause)' in caplog.text
