# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Targets of a marine radar (NMEA) and ships with AIS become plots; odd sentences are counted."""

from collections import Counter
from datetime import datetime, timezone
from functools import reduce
from operator import xor
import socket

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools.ais.__main__ import main as ais_main
from tracking_tools.ais.sentences import read_positions
from tracking_tools.bags import open_bag
from tracking_tools.feeds.feed import AHEAD, Feed
from tracking_tools.feeds.report import polar_of
from tracking_tools.feeds.sources import open_udp
from tracking_tools.nmea.__main__ import main
from tracking_tools.nmea.sentences import read_sentences

pytest.importorskip('pynmea2')
pyais = pytest.importorskip('pyais')
ORIGIN = (54.5, 10.2)  # deg
DEGREE = 111_412.0  # m along a meridian at 54.5 degrees, within 0.1 %


def sentence(body):
    """Return a sentence with its checksum."""
    return f'${body}*{reduce(xor, body.encode()):02X}\r\n'.encode()


def ttm(number=5, distance='10.0', bearing='90.0', reference='T', status='T', utc='120000.50'):
    """Return a tracked target."""
    rest = f'12.0,270.0,T,0.5,3.2,N,NAME,{status},,{utc},A'
    told = '' if number is None else f'{number:02d}'
    return sentence(f'RATTM,{told},{distance},{bearing},{reference},{rest}')


def ais(**changes):
    """Return a position report."""
    values = {'type': 1, 'mmsi': 211_234_560, 'lat': 54.6, 'lon': 10.2, 'second': 30, **changes}
    return pyais.encode_dict(values, talker_id='AI', sentence_type='VDM')[0].encode() + b'\r\n'


def on_sphere(latitude, longitude, origin):
    """Return range [m] and azimuth [rad] by the formulas of navigation."""
    (up, turn), (up0, turn0) = np.radians([latitude, longitude]), np.radians(origin)
    north = np.cos(up0) * np.sin(up) - np.sin(up0) * np.cos(up) * np.cos(turn - turn0)
    east = np.cos(up) * np.sin(turn - turn0)
    along = np.sin(up0) * np.sin(up) + np.cos(up0) * np.cos(up) * np.cos(turn - turn0)
    return DEGREE * np.degrees(np.arctan2(np.hypot(east, north), along)), np.arctan2(north, east)


@pytest.mark.parametrize('origin', [ORIGIN, (75.0, 179.9), (-75.0, -179.9), (-0.1, 6.0)])
@pytest.mark.parametrize('step', [(0.3, 0.0), (0.2, 0.9), (-0.25, -0.5), (0.0, 1.0)])
def test_places_are_where_a_radar_at_the_origin_sees_them(origin, step):
    """Oracle: the sphere, which the ellipsoid is near, across the date line, and the way back."""
    latitude, longitude = origin[0] + step[0], (origin[1] + step[1] + 180.0) % 360.0 - 180.0
    distance, azimuth = polar_of(latitude, longitude, origin)
    expected = on_sphere(latitude, longitude, origin)
    assert distance == pytest.approx(expected[0], rel=1e-2)  # radii of curvature
    assert azimuth == pytest.approx(expected[1], abs=3.5e-3)
    assert polar_of(*origin, (latitude, longitude))[0] == pytest.approx(distance, rel=1e-9)


def test_ttm_is_a_plot_with_our_units_and_time():
    """10 NM in the east, half a second after noon, number 5."""
    (report,) = read_sentences(ttm(), Counter())
    assert report.range == 18_520.0
    assert report.azimuth == pytest.approx(0.0)
    assert (report.source, report.time_of_day, report.track) == ('RA', 43_200.5, 5)


def test_bearings_from_ahead_are_for_the_ships_frame_only():
    """Starboard is negative; both kinds do not mix."""
    counts = Counter()
    told = ttm(bearing='30.0', reference='R')
    assert not read_sentences(told, counts)
    (report,) = read_sentences(told + ttm(), counts, relative=True)
    assert report.azimuth == pytest.approx(np.radians(-30.0))
    assert counts == {'bearing from ahead': 1, 'true bearing': 1}


def test_tll_is_a_plot_where_the_origin_is_known():
    """Latitude and longitude in degrees and minutes."""
    told = sentence('RATLL,03,5436.000,N,01012.000,E,NAME,120001.00,T,')
    counts = Counter()
    assert not read_sentences(told, counts)
    assert counts == {'TLL without --origin': 1}
    (report,) = read_sentences(told, counts, ORIGIN)
    assert report.range == pytest.approx(0.1 * DEGREE, rel=3e-3)
    assert np.degrees(report.azimuth) == pytest.approx(90.0)


def test_what_is_no_target_is_counted_by_reason():
    """Lost targets, other sentences, wrong checksums, empty fields, binary."""
    counts = Counter()
    data = [
        ttm(status='L'), ttm(distance=''), sentence('RARSD,,,,,,,,,,,,,'), ttm()[:-4] + b'00\r\n',
        b'\xff\xfe\r\n', ttm(utc='999999.99'), b'$' + b'A' * 5000 + b'\r\n',
    ]  # fmt: skip
    assert len(read_sentences(b''.join(data), counts)) == 0
    assert counts == {
        'lost target': 1, 'without range or bearing': 1, 'another sentence': 1,
        'damaged sentence': 2, 'not a sentence': 2,
    }  # fmt: skip


def test_ais_position_is_a_plot():
    """North of the origin; the MMSI is the id, the second tells the time."""
    (report,) = read_positions(ais(), Counter(), ORIGIN)
    assert report.range == pytest.approx(0.1 * DEGREE, rel=3e-3)
    assert np.degrees(report.azimuth) == pytest.approx(90.0, abs=0.01)
    assert (report.track, report.second) == (211_234_560, 30.0)


def test_ais_without_a_position_is_counted():
    """Ships that do not know where they are, and other messages."""
    counts = Counter()
    other = pyais.encode_dict({'type': 4, 'mmsi': 1}, talker_id='AI', sentence_type='VDM')[
        0
    ].encode()
    assert not read_positions(ais(lat=91.0, lon=181.0) + other, counts, ORIGIN)
    assert counts == {'without a position': 1, 'another message': 1}


@settings(max_examples=200)
@given(st.binary(max_size=100), st.text('!$*,0123456789ABTMVDLRAI.', max_size=90))
def test_any_bytes_are_read_without_an_error(data, text):
    """Noise, and noise with the letters and a valid checksum of a sentence."""
    for chunk in (
        data,
        text.encode(),
        sentence(f'RATTM,{text}'),
        b'!AIVDM,1,1,,A,' + data + b',0*00',
        b'!' + sentence(f'AIVDM,1,1,,A,{text},0')[1:],
    ):
        read_sentences(chunk, Counter(), ORIGIN)
        read_positions(chunk, Counter(), ORIGIN)


def test_sentences_within_an_interval_are_one_message():
    """A radar sends its targets one by one; a second of the minute is the nearest one."""
    feed = Feed(read_sentences, rosbags_types(), 'radar', 0.0, interval=2.0)
    sent = [ttm(1, utc='000001.00'), ttm(2, utc='000002.00'), ttm(1, utc='000003.00')]
    messages = [to_columns(msg, 9) for _, msg in feed.messages(sent)]
    assert [msg['id'].tolist() for msg in messages] == [[1, 2], [1]]
    np.testing.assert_allclose(messages[0]['time'] - AHEAD, [0.0, 1.0])

    def read(data, counts):
        return read_positions(data, counts, ORIGIN)

    feed = Feed(read, rosbags_types(), 'map', 0.0)
    stamp, _ = feed.take(ais(second=58), 6_000.0 + 61.0)
    assert stamp == 6_000.0 + 58.0 - AHEAD
    assert feed.take(ais(second=60)) is None  # neither a second nor a clock
    assert feed.counts['without a time'] == 1


def test_what_waits_is_told_once_its_interval_is_over():
    """Sentences 0.3 s apart, nothing in between: still one message a turn."""
    feed = Feed(read_sentences, rosbags_types(), 'radar', 43_200.0, interval=2.0)
    told = []
    for turn in range(3):
        for number in range(5):
            now = 100.0 + 2.5 * turn + 0.3 * number
            utc = f'1200{2.5 * turn + 0.3 * number:05.2f}'
            told += [feed.take(ttm(number, utc=utc), now), feed.overdue(now + 0.2)]
        told.append(feed.overdue(100.0 + 2.5 * turn + 2.1))
    messages = [msg for _, msg in filter(None, told)]
    assert [msg.width for msg in messages] == [5, 5, 5]
    assert feed.counts == {'plots': 15}


@pytest.mark.parametrize('turn', [0.5, 1.0, 2.5])
def test_target_told_twice_within_an_interval_is_one_plot(turn):
    """
    Radars tell their targets once or twice a second; each is one contact, where it was last.

    Their numbers begin at 00.
    """
    feed = Feed(read_sentences, rosbags_types(), 'radar', 43_200.0, interval=2.0)
    lines = [
        ttm(number, f'{number + 1.0 + 0.001 * step:.3f}', utc=f'1200{turn * step:05.2f}')
        for step in range(int(20.0 / turn))
        for number in (0, 1, 2)
    ]
    messages = [to_columns(msg, 9) for _, msg in feed.messages(lines)]
    assert [msg['id'].tolist() for msg in messages] == [[0, 1, 2]] * len(messages)
    told_last = int(20.0 / turn) - 1
    assert messages[-1]['range'][0] == pytest.approx(1852.0 * (1.0 + 0.001 * told_last))
    assert len(messages) == pytest.approx(20.0 / max(turn, 2.0), abs=1)


def test_port_that_another_feed_hears_is_refused():
    """Of two that hear one port of this machine only the last one would be sent to."""
    with socket.socket(type=socket.SOCK_DGRAM) as free:
        free.bind(('127.0.0.1', 0))
        port = free.getsockname()[1]
    with open_udp(f'udp://127.0.0.1:{port}'), pytest.raises(OSError, match='in use'):
        open_udp(f'udp://127.0.0.1:{port}')
    everybody = f'udp://0.0.0.0:{port}'
    with open_udp(everybody), open_udp(everybody):
        pass


def test_targets_without_a_number_are_all_told():
    """Nobody knows which of them are the same."""
    feed = Feed(read_sentences, rosbags_types(), 'radar', 43_200.0, interval=2.0)
    ((_, msg),) = feed.messages([ttm(None), ttm(None, distance='11.0')])
    assert msg.width == 2


def test_clock_of_a_sender_that_stands_still_ends_messages_all_the_same():
    """A radar without a fix sends one time for ever: what waits is bounded, live."""
    feed = Feed(read_sentences, rosbags_types(), 'radar', 43_200.0, interval=2.0)
    told = [
        feed.take(ttm(step % 90 + 1, utc='120000.00'), 100.0 + 0.1 * step) for step in range(200)
    ]
    widths = [msg.width for _, msg in filter(None, told)]
    assert max(widths) <= 21
    assert sum(widths) >= 200 - 21


@pytest.mark.parametrize('wrong', ['130003.00', '115500.00'])
def test_time_that_goes_back_ends_a_message_and_is_counted(wrong):
    """One sentence is an hour ahead, or five minutes behind: the others lose nothing."""
    feed = Feed(read_sentences, rosbags_types(), 'radar', 43_200.0, interval=2.0)
    lines = [ttm(second + 1, utc=f'1200{second:05.2f}') for second in range(20)]
    lines.insert(10, ttm(30, utc=wrong))
    messages = [msg for _, msg in feed.messages(lines)]
    assert sum(msg.width for msg in messages) == 21
    assert max(msg.width for msg in messages) == 2
    assert feed.counts['time went back'] == 1


def test_ais_with_a_wrong_checksum_or_of_own_ship_is_counted():
    """A bit may flip in a position: then the checksum is wrong, or the last part is gone."""
    counts, whole = Counter(), ais()
    place = whole.index(b',,') + 8
    flipped = (
        whole[:place] + (b'0' if whole[place : place + 1] != b'0' else b'1') + whole[place + 1 :]
    )
    assert len(read_positions(whole, counts, ORIGIN)) == 1
    assert read_positions(flipped + whole.split(b'*')[0] + b'\r\n', counts, ORIGIN) == []
    own = whole.split(b'*')[0].replace(b'AIVDM', b'AIVDO')
    own += f'*{reduce(xor, own[1:]):02X}\r\n'.encode()
    assert read_positions(own, counts, ORIGIN) == []
    assert counts == {'damaged sentence, or a part of one': 2, 'another sentence': 1}


def test_nmea_file_becomes_a_bag(tmp_path, capsys):
    """Over midnight of the day that the user says."""
    path, bag = tmp_path / 'watch.nmea', tmp_path / 'bag'
    path.write_bytes(b''.join(ttm(utc=utc) for utc in ('235958.00', '000001.00', '000004.00')))
    assert main([str(path), '--bag', str(bag), '--date', '2026-03-01']) == 0
    assert 'RA: plots 3' in capsys.readouterr().out
    midnight = datetime(2026, 3, 2, tzinfo=timezone.utc).timestamp()
    with open_bag(bag) as recorded:
        stamps = [time_ns / 1e9 for _, time_ns, _ in recorded.messages()]
    np.testing.assert_allclose(np.array(stamps) - midnight + AHEAD, [-2.0, 1.0, 4.0], atol=1e-6)


def test_file_without_targets_makes_no_bag(tmp_path, capsys):
    """A wrong file is told, with what was found in it."""
    path, bag = tmp_path / 'notes.txt', tmp_path / 'bag'
    path.write_text('not a sentence\n')
    assert main([str(path), '--bag', str(bag)]) == 1
    assert 'gives no message; no reports: damaged sentence 1' in capsys.readouterr().err
    assert not bag.exists()


def test_ais_without_an_origin_is_told(capsys):
    """No traceback."""
    assert ais_main(['udp://127.0.0.1:10111']) == 1
    assert '--origin LAT LON' in capsys.readouterr().err
