# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ships report by AIS when they like, with clocks that may be wrong, and are tracked."""

from collections import Counter
from functools import partial
from logging import getLogger

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from radar_tracker.config import RadarTrackerConfig, ScanConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_tools.ais.__main__ import AIS, main
from tracking_tools.ais.sentences import read_positions
from tracking_tools.bags import open_bag
from tracking_tools.feeds.feed import AHEAD, Feed

pyais = pytest.importorskip('pyais')
ORIGIN, NOON = (54.5, 10.2), 1_772_366_400.0  # deg; s since the epoch
SHIPS = 6


def sentence(number, time, **changes):
    """Return the report of a ship that goes north at 0.0001 degrees in a second."""
    values = {'type': 1, 'mmsi': 211_000_000 + number, 'second': int(time) % 60, **changes}
    place = {'lat': 54.55 + 0.0001 * (time - NOON), 'lon': 10.2 + 0.05 * number}
    sent = pyais.encode_dict(place | values, talker_id='AI', sentence_type='VDM')
    return sent[0].encode() + b'\r\n'


def reports(interval, duration, wrong=0.0):
    """Yield sentences and when they come; the clock of the first ship is wrong by so much [s]."""
    for step in range(int(duration / interval)):
        for number in range(SHIPS):
            time = NOON + interval * (step + number / SHIPS)
            second = int(time + (wrong if number == 0 else 0.0)) % 60
            yield sentence(number, np.floor(time), second=second), time + 0.5


def new_feed(interval):
    """Return a feed of AIS."""
    return Feed(partial(read_positions, origin=ORIGIN), rosbags_types(), 'map', NOON, interval)


@pytest.mark.parametrize(('interval', 'wrong'), [(10.0, 0.0), (10.0, 18.0), (2.0, -18.0)])
def test_ships_are_tracked_whatever_their_intervals_and_clocks(interval, wrong):
    """Ten seconds are usual; a receiver that has not heard of leap seconds is 18 s off."""
    feed, log = new_feed(AIS.interval), getLogger('ais')
    config = RadarTrackerConfig(scan=ScanConfig(assembly='snapshot'))
    radar = radar_session(config, radar_node_config(), rosbags_types(), log)
    for data, now in reports(interval, 150.0, wrong):
        told = feed.take(data, now)
        if told is not None:
            radar.plots(told[1], now)
    assert radar.counts['plots'].refused == Counter()
    assert radar.counts['plots'].late_used == 0
    assert radar.tracks.confirmed.sum() == SHIPS


@pytest.mark.parametrize(('second', 'stamp'), [(57, 57.0), (1, 61.0), (40, 60.0), (20, 60.0)])
def test_second_is_believed_where_it_is_near_the_arrival(second, stamp):
    """Heard a minute after noon: 3 s old, 1 s ahead; and 20 s off, either way."""
    feed = new_feed(0.0)
    told = feed.take(sentence(0, NOON, second=second), NOON + 60.0)
    assert told[0] - NOON + AHEAD == pytest.approx(stamp, abs=1e-6)
    assert feed.counts['second unlike the time of arrival'] == (second in (20, 40))


def test_all_that_moves_and_tells_where_it_is_counts():
    """Class B with its name, aircraft that search; not those whose receiver does not work."""
    name = {'shipname': 'NAME', 'ship_type': 37}
    data = sentence(0, NOON, type=19, **name) + sentence(1, NOON, type=9, alt=300)
    counts = Counter()
    told = read_positions(data + sentence(2, NOON, second=63), counts, ORIGIN)
    assert [report.track for report in told] == [211_000_000, 211_000_001]
    assert counts == {'without a position': 1}


def test_file_has_the_times_of_its_tags(tmp_path, capsys):
    """Loggers write when each sentence came; a file without is told."""
    path, bag = tmp_path / 'log.nmea', tmp_path / 'bag'
    lines = [sentence(0, NOON + step, second=60) for step in (0.0, 30.0, 60.0)]
    path.write_bytes(b''.join(lines))
    command = [str(path), '--bag', str(bag), '--origin', *map(str, ORIGIN)]
    assert main(command) == 1
    assert 'without a time 3' in capsys.readouterr().err
    tags = (b'\\c:1772366400*5D\\', b'\\c:1772366430*5E\\', b'\\c:1772366460*5B\\')
    path.write_bytes(b''.join(tag + line for tag, line in zip(tags, lines, strict=True)))
    assert main(command) == 0
    with open_bag(bag) as recorded:
        stamps = [time_ns / 1e9 - NOON for _, time_ns, _ in recorded.messages()]
    np.testing.assert_allclose(np.array(stamps) + AHEAD, [0.0, 30.0, 60.0], atol=1e-5)
