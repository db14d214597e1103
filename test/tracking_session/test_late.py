# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots that come late are used at their own time: the tracks are those of the right order."""

import logging
from types import SimpleNamespace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from msg_adapters.message_types import rosbags_types, seconds
from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_core.config import with_values
from tracking_core.platform import StalePlatform
from tracking_session.node_config import LateConfig
from tracking_session.orders import cancel
from tracking_tools.scenarios import build
from tracking_tools.scenarios.messages import send

TYPES = rosbags_types()
PERIOD = 4.0
ROWS = ('x', 'y', 'z', 'vx', 'vy', 'vz', 'covariance', 'existence_probability', 'status', 'time')


def radar(late=3, **values):
    """Return a session that takes messages so many scans late."""
    config = with_values(RadarTrackerConfig(), values)
    node = with_values(radar_node_config(), {'scan.late': late})
    return radar_session(config, node, TYPES, logging.getLogger('late'))


def scans(sectors, turns=40):
    """Return the plots of aircraft in a terminal area, clutter and all."""
    sent = send(build('terminal'), TYPES, sectors)
    return [next(sent)[0].msg for _ in range(turns * sectors)]


def shuffled(messages, seed, most=3, start=0):
    """Return the messages, each with up to `most` newer ones before it; the last stays last."""
    rng, count = np.random.default_rng(seed), len(messages)
    delay = rng.integers(0, most + 1, count) * (np.arange(count) >= start)
    delay[-1] = most + 1
    return [messages[k] for k in np.argsort(np.arange(count) + delay, kind='stable')]


def run(session, messages):
    """Feed messages; return the tables that come back."""
    tables = [session.plots(msg, 0.0) for msg in messages]
    return [to_columns(table, 10_000) for table in tables if table is not None]


def same_rows(one, other, ids=False):
    """Check that two tables have the same living tracks, in whatever order."""
    one, other = ({n: c[t['status'] < 2] for n, c in t.items()} for t in (one, other))
    order = [np.lexsort((t['y'], t['x'])) for t in (one, other)]
    for name in (*ROWS, 'id') if ids else ROWS:
        assert_allclose(one[name][order[0]], other[name][order[1]], rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize('seed', range(4))
@pytest.mark.parametrize('sectors', [1, 8])
def test_shuffled_delivery_gives_the_tracks_of_ordered_delivery(seed, sectors) -> None:
    """Up to 3 scans late from the first on, whole turns or sectors: the same rows at the end."""
    messages, values = scans(sectors), {'scan.assembly': 'sector' if sectors > 1 else 'message'}
    session = radar(**values)
    order = shuffled(messages, seed)
    stamps = np.array([seconds(msg.header.stamp) for msg in order])
    mixed, ordered = run(session, order), run(radar(**values), messages)
    count = session.counts['plots']
    assert count.late_used == np.sum(stamps < np.maximum.accumulate(stamps)) > 0
    assert count.late_used + len(mixed) == len(messages)
    assert len(mixed[-1]['id']) >= 5
    same_rows(mixed[-1], ordered[-1])


def test_ids_that_were_published_stay() -> None:
    """Tracks begin before, while and after messages are late; ids are never given twice."""
    messages = scans(1)
    session, born = radar(), {}
    for table in run(session, shuffled(messages, 2, start=5)):
        for number, x, y in zip(table['id'], table['x'], table['y'], strict=True):
            if number in born:  # within what an aircraft flies in four turns, and its error
                assert np.hypot(x - born[number][0], y - born[number][1]) < 6_000.0
            born[number] = x, y
    ordered = run(radar(), messages)[-1]
    same_rows({n: c[table['hits'] > 25] for n, c in table.items()},
              {n: c[ordered['hits'] > 25] for n, c in ordered.items()}, ids=True)  # fmt: skip
    assert session.instrument.tracker.state.next_id > max(born)


@pytest.mark.parametrize('seed', range(5))
def test_ids_stay_when_a_second_message_is_late(seed) -> None:
    """Contacts tens of kilometres apart, seen four times in five: an id never names another."""
    rng = np.random.default_rng(seed)
    place = 30e3 * np.stack(np.meshgrid(range(4), range(3)), axis=-1).reshape(-1, 2)
    speed = rng.uniform(-150.0, 150.0, place.shape)

    def turn(k):
        at = (place + PERIOD * k * speed + rng.normal(0.0, 30.0, place.shape))[
            rng.random(12) < 0.8
        ]
        return from_columns({'x': at[:, 0], 'y': at[:, 1]}, 1_000.0 + PERIOD * k, 'radar', TYPES)

    messages, session, owner = [turn(k) for k in range(12)], radar(), {}
    for table in run(session, [messages[k] for k in (0, 1, 4, 2, 3, *range(5, 12))]):
        at = np.stack([table['x'], table['y']], axis=1)
        nearest = np.hypot(*(at[:, None] - place).T).argmin(axis=0)
        for number, contact in zip(table['id'], nearest, strict=True):
            assert owner.setdefault(number, contact) == contact
    assert session.counts['plots'].late_used == 2
    assert (table['status'] == 1).sum() == 12


def test_tracks_that_begin_once_more_keep_their_ids() -> None:
    """Told after the first and the third message, they begin with the second when it comes."""
    place = 30e3 * np.stack(np.meshgrid(range(4), range(3)), axis=-1).reshape(-1, 2)
    messages = [
        from_columns({'x': place[:, 0], 'y': place[:, 1]}, 1_000.0 + PERIOD * k, 'radar', TYPES)
        for k in range(4)
    ]
    first, told, after = run(radar(), [messages[k] for k in (0, 2, 1, 3)])
    assert (len(first['id']), len(told['id'])) == (0, 12)
    assert (after['hits'] == 4).all()
    ids = [
        {(x, y): n for n, x, y in zip(t['id'], t['x'].round(-3), t['y'].round(-3), strict=True)}
        for t in (told, after)
    ]
    assert ids[0] == ids[1]


def test_stamps_of_the_tables_rise() -> None:
    """A late message is not answered; the next table shows what it changed."""
    messages = scans(1, 12)
    session = radar()
    run(session, messages[:9])
    assert session.plots(messages[10], 0.0) is not None
    assert session.plots(messages[9], 0.0) is None
    assert session.stamp == messages[10].header.stamp
    changed = to_columns(session.plots(messages[11], 0.0), 10_000)
    same_rows(changed, run(radar(), messages)[-1], ids=True)


def test_older_ones_and_copies_are_dropped_and_counted() -> None:
    """Four scans late is too late, copies are refused as ever, with 0 all that is late too."""
    messages = scans(1, 12)
    session, strict = radar(), radar(late=0)
    for one in (session, strict):
        run(one, [*messages[:5], *messages[6:10], messages[5], messages[9], messages[7]])
    assert (session.counts['plots'].late_used, session.counts['plots'].late_dropped) == (0, 1)
    assert sum(session.counts['plots'].refused.values()) == 3
    run(session, [messages[11], messages[10]])
    run(strict, [messages[11], messages[10]])
    assert session.counts['plots'].late_used == 1
    assert (strict.counts['plots'].late_used, strict.counts['plots'].late_dropped) == (0, 3)


@pytest.mark.parametrize('used', [True, False])
def test_narrow_sectors_too_may_be_three_scans_late(used, monkeypatch, caplog) -> None:
    """48 a turn, one 2.9 scans late; where there is no room for so many the log says so."""
    if not used:
        monkeypatch.setattr('tracking_session.history.MOST', 64)
    messages = scans(48, 6)
    session, late = radar(**{'scan.assembly': 'sector'}), messages.pop(-140)
    run(session, [*messages, late])
    count = session.counts['plots']
    assert (count.late_used, count.late_dropped) == (used, not used)
    assert ('scan.late are dropped: no more messages are kept than' in caplog.text) is not used


def test_recording_that_begins_anew_still_starts_anew() -> None:
    """A jump back beyond the last scans is a jump of the clock, not a crowd of late messages."""
    messages, session = scans(1, 30), radar()
    run(session, [*messages, *messages])
    assert session.guard.jumps == 1
    assert session.counts['plots'].late_used == 0


def test_late_scans_of_a_recording_that_began_anew_are_used() -> None:
    """Those from before say nothing of what is late now."""
    messages, session = scans(1, 12), radar()
    first = [*messages[:3], messages[4], messages[3], *messages[5:9]]
    run(session, [*messages, *first])
    assert session.guard.jumps == 1
    assert session.counts['plots'].late_used == 1


def test_late_scan_that_cannot_be_used_changes_nothing(monkeypatch) -> None:
    """Its own ship is not known, say; a copy that can be used still finds its place."""
    messages, session = scans(1, 12), radar()
    run(session, [*messages[:9], messages[10]])
    before = session.tracks
    with monkeypatch.context() as patch:
        patch.setattr(session.instrument, 'track', refuse)
        assert session.plots(messages[9], 0.0) is None
    assert session.counts['plots'].refused['own ship stale'] == 1
    assert session.tracks is before
    assert session.plots(messages[9], 0.0) is None
    assert session.counts['plots'].late_used == 1
    same_rows(run(session, messages[11:])[-1], run(radar(), messages)[-1], ids=True)


def refuse(*_):
    """Do what a tracker does that does not know where own ship was."""
    raise StalePlatform('not known')


def test_commands_of_a_user_are_not_undone() -> None:
    """A track that was dropped does not come back with plots from before."""
    messages, session = scans(1, 20), radar()
    tables = run(session, [*messages[:16], messages[17]])
    number = int(tables[-1]['id'][tables[-1]['status'] == 1][0])
    cancel(session, SimpleNamespace(data=number))
    run(session, [messages[16], messages[18]])
    assert session.counts['plots'].late_dropped == 1
    assert number not in session.tracks.id


def polar(stamp, *elevation):
    """Return three plots, with heights as soon as one is given."""
    columns = {'range': np.array([8e3, 12e3, 15e3]), 'azimuth': np.array([0.0, 1.5, -2.0])}
    if elevation:
        columns['elevation'] = np.array(elevation)
    return from_columns(columns, stamp, 'radar', TYPES)


@pytest.mark.parametrize('first', [(1.0, 5.0, 9.0), (1.0, 5.0)])
def test_late_message_may_be_the_first_with_heights(first) -> None:
    """The radar is 3-D from then on; what was 2-D is followed once more with new ids."""
    session = radar()
    tables = run(session, [polar(stamp) for stamp in first])
    flat = set(tables[-1]['id'])
    assert flat
    assert session.plots(polar(3.0, 0.3, 0.2, 0.1), 0.0) is None
    assert session.counts['plots'].late_used == 1
    assert session.instrument.tracker.radar.dimensions == 3
    table = run(session, [polar(first[-1] + PERIOD, 0.3, 0.2, 0.1)])[-1]
    assert not flat & set(table['id'][table['status'] < 2])


def test_late_parameter_has_limits() -> None:
    """The message names it."""
    with pytest.raises(ValueError, match=r'LateConfig.late must be in \[0, 20\]'):
        LateConfig(late=21)


def test_sonar_too_uses_late_bearings() -> None:
    """Two contacts, marks shuffled: the same bearings in the end."""
    rng = np.random.default_rng(1)

    def cycle(k):
        bearing = np.array([0.5, 2.0]) + 1e-3 * k + rng.normal(0.0, 2e-3, 2)
        columns = {'bearing': bearing, 'bearing_sd': np.full(2, 2e-3)}
        return from_columns(columns, 1_000.0 + 2.0 * k, 'sonar', TYPES)

    def session():
        log = logging.getLogger('late')
        return sonar_session(SonarTrackerConfig(), sonar_node_config(), TYPES, log)

    messages, mixed = [cycle(k) for k in range(40)], session()
    one, other = run(mixed, shuffled(messages, 3))[-1], run(session(), messages)[-1]
    assert mixed.counts['bearings'].late_used > 5
    assert (other['status'] == 1).sum() == 2
    order = [np.argsort(t['bearing']) for t in (one, other)]
    for name in ('bearing', 'bearing_rate', 'status'):
        assert_allclose(one[name][order[0]], other[name][order[1]], rtol=1e-5)
    assert_array_equal(np.sort(one['id']), np.unique(one['id']))
