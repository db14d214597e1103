# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which late messages have a place, and how many messages are kept."""

import pytest

from tracking_session.history import History, MOST, Step


def filled(stamps, scans=3, turn=0.0, margin=10.0):
    """Return a history of messages with these stamps."""
    history = History(scans, margin)
    for stamp in stamps:
        history.add(Step(stamp, None, None, None, None), turn)
    return history


def test_late_messages_have_a_place_for_three_scans():
    """Between the scans that are kept, not before them, not twice."""
    history = filled([0.0, 4.0, 8.0, 12.0, 16.0])
    assert [history.takes(t) for t in (4.0, 5.0, 8.0, 9.0, 15.0, 16.0, 17.0)] == [
        False, True, False, True, True, False, False,
    ]  # fmt: skip
    assert [history.has_lost(t) for t in (3.9, 4.0, 5.0)] == [True, False, False]


def test_first_messages_may_be_preceded_by_the_margin_only():
    """Nothing is known to be missing before the first message."""
    history = filled([100.0])
    assert history.takes(95.0)
    assert not history.takes(89.0)
    assert not History(3, 10.0).takes(0.0)


def test_sectors_are_kept_for_three_turns():
    """Eight sectors a turn: three turns are 24 messages."""
    history = filled([0.5 * k for k in range(100)], turn=4.0)
    assert history.takes(49.5 - 12.0 + 0.1)
    assert not history.takes(49.5 - 12.0 - 0.6)


def test_memory_is_bounded():
    """However small the sectors are."""
    history = filled([1e-3 * k for k in range(1000)], turn=4.0)
    assert len(history.take_after(-1.0)) == MOST


@pytest.mark.parametrize('scans', [0, 1, 5])
def test_as_many_scans_are_kept_as_the_parameter_says(scans):
    """None at all with 0."""
    history = filled([4.0 * k for k in range(20)], scans)
    assert history.takes(4.0 * (19 - scans) + 1.0) == (scans > 0)
    assert not history.takes(4.0 * (18 - scans) + 1.0)
    assert len(history.take_after(-1.0)) == scans
    assert not filled([0.0, 4.0], 0, turn=4.0).takes(2.0)


def test_nothing_comes_before_what_was_closed():
    """A user's command is not undone."""
    history = filled([0.0, 4.0])
    history.close()
    history.add(Step(8.0, None, None, None, None), 0.0)
    assert history.takes(6.0)
    assert not history.takes(3.0)
