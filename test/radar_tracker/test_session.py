# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What happens to messages without a ROS graph: good ones track, bad ones hurt nobody."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session

message_types = pytest.importorskip('msg_adapters.message_types')
pytest.importorskip('rosbags')
TYPES = message_types.rosbags_types()
PERIOD = 4.0
ODD = [np.nan, np.inf, -np.inf, -1.0, 0.0, 1e-300, 1e30, 1e300, 7.0, 500.0]
NOTHING = {'range': np.zeros(0), 'azimuth': np.zeros(0)}
SEEN = {'range': np.array([2e4, 3e4]), 'azimuth': np.array([0.0, 1.0])}
SOLID = SEEN | {'elevation': np.array([0.1, 0.2])}


def session(**changes):
    """Return a session with default parameters, some changed."""
    log = logging.getLogger('session')
    return radar_session(RadarTrackerConfig(), replace(radar_node_config(), **changes), TYPES, log)


def scan(number):
    """Return the plots of five contacts on straight courses."""
    rng = np.random.default_rng(number)
    time, start = PERIOD * number, np.array([20e3, -30e3, 40e3, -50e3, 60e3])
    x, y = start + 120.0 * time, 0.5 * start[::-1] - 80.0 * time
    azimuth = np.arctan2(y, x) + rng.normal(0.0, 1e-3, 5)
    columns = {'range': np.hypot(x, y) + rng.normal(0.0, 30.0, 5), 'azimuth': azimuth}
    return from_columns(columns, 1000.0 + time, 'radar', TYPES)


def follow(radar, numbers):
    """Feed scans; return the ids of the confirmed tracks in the last table."""
    for number in numbers:
        columns = to_columns(radar.plots(scan(number), 0.0), 10_000)
    return set(columns['id'][columns['status'] == 1].tolist())


def hostile(rng, stamp):
    """Return a message with odd names, values, rows, stamp and frame."""
    names = rng.choice(
        ['range', 'azimuth', 'x', 'y', 'z', 'elevation', 'time', 'range_sd', 'azimuth_sd', 'v'],
        rng.integers(1, 8), replace=False,
    )  # fmt: skip
    rows = rng.integers(0, 6)
    columns = {str(name): rng.choice(ODD, rows) for name in names}
    wrong = stamp + rng.choice([1e9, -1e9, 3600.0, -3600.0, -PERIOD - 1.0, -PERIOD])
    return from_columns(columns, wrong, str(rng.choice(['radar', '', 'other'])), TYPES)


@pytest.mark.parametrize('seed', range(5))
def test_hostile_messages_between_scans_change_nothing(seed):
    """All five tracks live through sixty scans with a bad message before each."""
    rng, radar = np.random.default_rng(seed), session()
    before = follow(radar, range(12))
    assert len(before) == 5
    for number in range(12, 72):
        radar.plots(hostile(rng, 1000.0 + PERIOD * number), 0.0)
        after = follow(radar, [number])
    assert after == before


def test_odd_rows_within_good_scans_never_raise():
    """Rows of odd values are dropped or tracked, but nothing breaks."""
    rng, radar = np.random.default_rng(1), session()
    for number in range(60):
        columns = {
            name: rng.choice([*ODD, 0.1, 1e3, 2e4], 400)
            for name in ('range', 'azimuth', 'elevation', 'range_rate', 'snr', 'time', 'range_sd')
        }
        with np.errstate(all='raise', under='ignore'):
            msg = from_columns(columns, 1000.0 + PERIOD * number, 'radar', TYPES)
            table = radar.plots(msg, 0.0)
        assert table is not None  # some of the rows are good


def test_refused_first_message_decides_nothing():
    """A Cartesian message in a strange frame does not make later polar ones wrong."""
    radar = session(tracking_frame='radar')
    strange = from_columns({'x': np.ones(1), 'y': np.ones(1)}, 1.0, 'other', TYPES)
    assert radar.plots(strange, 0.0) is None
    assert len(follow(radar, range(12))) == 5


@pytest.mark.parametrize(
    ('fields', 'refused'),
    [
        ('range azimuth, azimuth x y', 1),
        ('azimuth x y, range azimuth', 1),
        ('azimuth x y, x y', 0),
    ],
)
def test_plots_are_polar_where_they_have_range_and_azimuth(fields, refused):
    """Places with an azimuth are none: after polar plots they are refused, not read as NaN."""
    radar = session()
    for stamp, names in enumerate(fields.split(', ')):
        columns = dict.fromkeys(names.split(), np.ones(1))
        radar.plots(from_columns(columns, 1000.0 + stamp, 'radar', TYPES), 0.0)
    assert radar.counts['plots'].refused['fields changed'] == refused
    assert radar.counts['plots'].rows == 2 - refused


@pytest.mark.parametrize(('set_to', 'told'), [('/radar', 'radar'), ('radar', '/radar')])
def test_frames_are_the_same_with_and_without_a_slash(set_to, told):
    """As ROS 1 wrote them; what is published has none, as tf2 wants it."""
    tracker, msg = session(tracking_frame=set_to), scan(1)
    msg.header.frame_id = told
    assert tracker.plots(msg, 0.0).header.frame_id == 'radar'


def test_stamp_of_the_plots_is_the_stamp_of_the_tracks():
    """To the nanosecond, so that consumers can pair them."""
    msg = scan(0)
    msg.header.stamp.sec, msg.header.stamp.nanosec = 1_700_000_000, 123_456_789
    table = session().plots(msg, 0.0)
    assert (table.header.stamp.sec, table.header.stamp.nanosec) == (1_700_000_000, 123_456_789)


def test_same_messages_give_the_same_bytes():
    """Nothing depends on when or how often it runs."""
    tables = [[bytes(radar.plots(scan(n), 0.0).data) for n in range(12)] for radar in
              (session(), session())]  # fmt: skip
    assert tables[0] == tables[1]


@pytest.mark.parametrize(('before', 'after'), [(SEEN, SOLID), (SEEN, NOTHING), (SOLID, NOTHING)])
def test_tracks_that_end_where_heights_are_found_or_all_is_forgotten_have_a_last_row(
    before, after
):
    """The tracks after it have other dimensions, or are none."""
    radar, tables = session(), []
    for columns, stamp in ((before, 1000.0), (before, 1004.0), (after, 1008.0)):
        if columns is NOTHING:
            radar.reset()
        msg = from_columns(columns, stamp, 'radar', TYPES)
        tables.append(to_columns(radar.plots(msg, 0.0), 100))
    assert tables[1]['status'].tolist() == [0, 0]
    assert tables[2]['id'][tables[2]['status'] == 2].tolist() == tables[1]['id'].tolist()


def turn(number, off=0.0):
    """Return a turn of an antenna that sees five contacts at rest; the third's time is off."""
    part = np.array([0.05, 0.15, 0.3, 0.45, 0.7])
    time = PERIOD * part
    time[2] += off
    columns = {'time': time, 'range': np.full(5, 2e4), 'azimuth': 2.0 * np.pi * part}
    return from_columns(columns, 1000.0 + PERIOD * number, 'radar', TYPES)


def around(off, turns):
    """Return the ledger, and the tracks before a wrong time and so many turns after it."""
    radar = session()
    tables = [radar.plots(turn(number, off * (number == 12)), 0.0) for number in range(13 + turns)]
    before, after = (to_columns(tables[number], 10_000) for number in (11, -1))
    return radar.ledger, before, after


@pytest.mark.parametrize('off', [-50.0, -20.0, -10.0, 7.0, 20.0, 50.0])
def test_one_wrong_time_does_not_stop_the_antenna(off):
    """Nobody else is missed for it, though the antenna cannot have turned on for so long."""
    ledger, before, after = around(off, 2)
    assert after['id'].tolist() == before['id'].tolist()
    gained = after['hits'] - before['hits']
    assert gained.tolist() == [3, 3, 2, 3, 3]
    assert ledger.counts['plots'].dropped == {'time more than 8 s off the stamp': 1}


@pytest.mark.parametrize('off', [-5.0, -3.0, 3.0, 5.0])
def test_wrong_time_within_a_turn_or_two_costs_no_id(off):
    """Such a time could be true; what it says of the antenna is soon outvoted."""
    _, before, after = around(off, 6)
    assert after['id'].tolist() == before['id'].tolist()
    assert (after['hits'] - before['hits'] >= 5).all()


def test_drawing_shows_where_tracks_were_and_how_their_gates_lie():
    """Trails go through the places told; gates of far contacts are long across the sight."""
    radar, told = session(), []
    for number in range(20):
        table = to_columns(radar.plots(scan(number), 0.0), 100)
        told.append({i: xy for i, *xy in zip(table['id'], table['x'], table['y'], strict=True)})
        radar.instrument.follow()
    drawn = radar.instrument.draw(set(), radar.header(), radar_node_config().markers).markers
    trails = {m.id: m.points for m in drawn if m.ns == 'history'}
    gates = {m.id: m for m in drawn if m.ns == 'gate'}
    assert len(trails) == len(gates) == 5
    for name, points in trails.items():
        newest_first = [places[name] for places in reversed(told) if name in places]
        np.testing.assert_allclose([[p.x, p.y] for p in points], newest_first, rtol=1e-6)
    for name, (x, y) in told[-1].items():
        if np.hypot(x, y) > 45e3:  # azimuth noise is more than 80 m, range noise 50 m
            turn, size = gates[name].pose.orientation, gates[name].scale
            across = 2.0 * np.arctan2(turn.z, turn.w) - np.arctan2(y, x) - 0.5 * np.pi
            assert (
                abs(np.sin(across)) < 0.2
            )  # the past noise of the track leans a little otherwise
            assert size.x > 1.3 * size.y
