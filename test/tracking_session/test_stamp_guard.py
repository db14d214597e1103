# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One bad stamp never hurts; a clock that truly moved is believed."""

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from tracking_session.stamp_guard import StampGuard
from tracking_session.throttle import Throttle


def feed(guard, stamps, received=0.0):
    """Return for each stamp 'used', 'reset', or the reason of its refusal."""
    answers = []
    for stamp in stamps:
        try:
            answers.append('reset' if guard.accept(stamp, received) else 'used')
        except BadMessage as error:
            answers.append(error.reason)
    return answers


def test_ordinary_stamps_are_used():
    """Steps of a slow antenna are ordinary."""
    assert feed(StampGuard(10.0), [0.0, 4.0, 8.0, 12.0]) == ['used'] * 4


@pytest.mark.parametrize(
    ('bad', 'reason'),
    [(3600.0, 'stamp ahead of time'), (-3600.0, 'stamp behind time'), (-1.0, 'stamp not newer')],
)
def test_one_bad_stamp_is_refused_and_forgotten(bad, reason):
    """The good ones around it are used without a reset."""
    answers = feed(StampGuard(10.0), [100.0, 104.0, 104.0 + bad, 108.0, 112.0])
    assert answers == ['used', 'used', reason, 'used', 'used']


def test_bad_stamps_between_good_ones_never_win():
    """However many there are, they do not agree in a row."""
    stamps = np.column_stack([np.arange(20) * 4.0, np.arange(20) * 4.0 + 5000.0]).ravel()
    assert 'reset' not in feed(StampGuard(10.0), stamps)


@pytest.mark.parametrize('jump', [-1000.0, 1000.0])
def test_clock_that_moved_is_believed_once(jump):
    """The third stamp in a row that agrees begins anew, and all after it are used."""
    guard = StampGuard(10.0)
    stamps = [100.0, 104.0, *(104.0 + jump + 4.0 * np.arange(1, 6))]
    answers = feed(guard, stamps)
    assert answers[2:4] == [answers[2]] * 2
    assert answers[4:] == ['reset', 'used', 'used']
    assert guard.jumps == 1


def test_silence_that_explains_a_gap_is_counted():
    """An hour without plots is no jump; the user sees that there was one silence."""
    guard = StampGuard(10.0)
    assert feed(guard, [100.0, 104.0]) == ['used', 'used']
    assert feed(guard, [3700.0, 3704.0], received=3600.0) == ['used', 'used']
    assert (guard.jumps, guard.silences) == (0, 1)


def test_repeated_strange_stamp_does_not_agree_with_itself():
    """A publisher that is stuck cannot move the clock."""
    assert 'reset' not in feed(StampGuard(10.0), [100.0, *[5000.0] * 9])


def test_silence_explains_a_gap():
    """After an hour without messages, a stamp an hour later is right."""
    guard = StampGuard(10.0)
    assert feed(guard, [100.0], received=50.0) == ['used']
    assert feed(guard, [3700.0], received=3650.0) == ['used']


def test_gap_does_not_make_the_guard_careless():
    """After a long silence a stamp an hour ahead is as wrong as before."""
    guard = StampGuard(10.0)
    feed(guard, [100.0, 104.0], received=0.0)
    feed(guard, [2104.0], received=2000.0)
    assert feed(guard, [5704.0], received=2000.0) == ['stamp ahead of time']


def test_slow_scans_in_fast_playback_are_believed():
    """Scans 30 s apart that come at once are taken for what they are after three."""
    answers = feed(StampGuard(10.0), np.arange(8) * 30.0)
    assert answers[3:] == ['reset', 'used', 'used', 'used', 'used']


def test_slow_antenna_may_lose_scans_in_fast_playback():
    """More than the threshold is missing: at first, after a restart and in the second round."""
    guard = StampGuard(10.0)
    assert feed(guard, [100.0, 108.0, 132.0]) == ['used'] * 3
    guard.recall({'newest': 108.0, 'interval': 8.0}, 0.0)
    assert feed(guard, [132.0]) == ['used']
    short = StampGuard(10.0)
    assert feed(short, [100.0, 104.0, 108.0, 100.0, 104.0, 124.0])[4:] == ['reset', 'used']


def test_clock_that_says_so_is_believed_at_once():
    """When simulated time went back, the first earlier stamp begins anew."""
    guard = StampGuard(10.0)
    feed(guard, [1000.0, 1004.0])
    guard.clock_moved()
    assert feed(guard, [10.0, 14.0]) == ['reset', 'used']


@pytest.mark.parametrize('first', [0.0, -0.5, -1.0])
def test_recording_shorter_than_the_threshold_may_be_played_again(first):
    """No stamp is as old as its first one: it begins anew with the second, in every round."""
    guard = StampGuard(10.0)
    later = [float(stamp) for stamp in range(1, 9)]
    for played_before in (False, True, True):
        begin = ['stamp not newer', 'reset'] if played_before else ['used', 'used']
        assert feed(guard, [100.0 + first, *np.add(100.0, later)]) == begin + ['used'] * 7
    assert guard.jumps == 2


def test_first_stamp_is_believed_at_once_where_the_clock_went_back_too():
    """However short the recording is."""
    guard = StampGuard(10.0)
    feed(guard, [100.0, 101.0, 102.0])
    guard.clock_moved()
    assert feed(guard, [100.0, 101.0]) == ['reset', 'used']


@pytest.mark.parametrize('stale', [100.0, 98.0, 95.0])
def test_one_message_from_before_the_first_is_refused(stale):
    """Sent late or twice, and however often: only one that follows it can be a new beginning."""
    guard = StampGuard(10.0)
    feed(guard, [100.0, 101.0, 102.0])
    refused = 'stamp not newer'
    assert feed(guard, [stale, 103.0, stale, stale, 103.0, 104.0]) == [
        refused, 'used', refused, refused, refused, 'used',
    ]  # fmt: skip
    assert guard.jumps == 0


def test_stamp_before_the_newest_but_not_the_first_is_none_to_begin_anew_with():
    """Nor is the very first stamp that is sent twice, or one that a restart has remembered."""
    guard = StampGuard(10.0)
    assert feed(guard, [100.0, 100.0, 104.0, 101.0])[1:] == [
        'stamp not newer', 'used', 'stamp not newer',
    ]  # fmt: skip
    memory = guard.remember()
    guard.recall(memory, 0.0)
    assert feed(guard, [99.0, 105.0]) == ['stamp not newer', 'used']


def test_refusal_says_both_times():
    """The text has the stamp, the last one and the parameter."""
    guard = StampGuard(10.0)
    guard.accept(100.0, 0.0)
    with pytest.raises(BadMessage, match=r'3700\.000 is 3600\.0 s ahead.*100\.000.*threshold 10'):
        guard.accept(3700.0, 0.0)


def test_throttle_says_each_reason_once_an_interval_with_the_count():
    """Other reasons are said at once."""
    now, said = [0.0], []
    throttle = Throttle(said.append, interval=5.0, clock=lambda: now[0])
    for _ in range(10):
        throttle('a', 'text a')
    throttle('b', 'text b')
    now[0] = 5.0
    throttle('a', 'text a')
    assert said == ['text a', 'text b', 'text a (9 more like this since the last line)']
