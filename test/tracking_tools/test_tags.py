# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Sentences from networks and loggers have tags before them, which tell when they were sent."""

from collections import Counter
from functools import reduce
from operator import xor

import numpy as np
import pytest

from tracking_tools.bags import open_bag
from tracking_tools.feeds.tags import time_of
from tracking_tools.nmea.__main__ import main
from tracking_tools.nmea.sentences import read_sentences

pytest.importorskip('pynmea2')
NOON = 1_772_366_400  # s since the epoch, of 2026-03-01


def checked(body):
    """Return the body with its checksum."""
    return f'{body}*{reduce(xor, body.encode()):02X}'


def tags(body):
    """Return a block of tags."""
    return f'\\{checked(body)}\\'


TTM = '$' + checked('RATTM,05,10.0,90.0,T,12.0,270.0,T,0.5,3.2,N,NAME,T,,,A') + '\r\n'


@pytest.mark.parametrize(
    'before',
    ['UdPbC\0' + tags('s:RA0001,n:17'), tags(f's:RA0001,c:{NOON}'), '2026-03-01T12:00:00Z ', ''],
)
def test_what_stands_before_a_sentence_is_no_damage(before):
    """A datagram of IEC 61162-450, tags of a logger, a time by hand, nothing."""
    counts = Counter()
    (report,) = read_sentences((before + TTM).encode(), counts)
    assert (report.range, report.track) == (18_520.0, 5)
    assert not counts


@pytest.mark.parametrize(
    ('body', 'time'),
    [
        (f'c:{NOON}', NOON),
        (f'g:1-2-34,s:r003669945,c:{NOON}500', NOON + 0.5),
        (f'c:{NOON},s:RA0001', NOON),
        ('s:RA0001', np.nan),
        (f'x:abc:{NOON}', np.nan),
    ],
)
def test_tags_tell_seconds_or_milliseconds(body, time):
    """Both are in use; other tags stand before and behind."""
    np.testing.assert_equal(time_of(tags(body) + TTM), time)
    assert np.isnan(time_of(tags(body).replace('*', '*F') + TTM))


def test_file_without_times_of_targets_has_those_of_its_tags(tmp_path):
    """Most radars leave the time of a target empty."""
    path, bag = tmp_path / 'watch.nmea', tmp_path / 'bag'
    path.write_text(''.join(tags(f'c:{NOON + 3 * turn}') + TTM for turn in range(4)), newline='')
    assert main([str(path), '--bag', str(bag)]) == 0
    with open_bag(bag) as recorded:
        stamps = [round(time_ns / 1e9, 1) for _, time_ns, _ in recorded.messages()]
    assert stamps == [NOON + 3 * turn for turn in range(4)]
