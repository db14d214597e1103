# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Counts are right and have names."""

from tracking_session.input_count import InputCount


def test_gaps_of_one_publisher_are_losses():
    """Three numbers missing are three messages lost."""
    count = InputCount()
    for number in (5, 6, 10):
        count.received(number, publishers=1)
    assert count.lost == 3
    assert count.messages == 3


def test_restart_and_second_publisher_are_no_losses():
    """Numbers that begin again, or interleave, mean nothing."""
    count = InputCount()
    count.received(100, publishers=1)
    count.received(1, publishers=1)
    count.received(700, publishers=2)
    count.received(None, publishers=1)
    count.received(900, publishers=1)
    assert count.lost == 0


def test_every_count_has_a_name():
    """Totals and reasons stand beside each other."""
    count = InputCount()
    count.refused['missing field'] += 2
    count.dropped['range is negative'] += 5
    values = count.values('plots')
    assert values['plots messages refused'] == 2
    assert values['plots refused: missing field'] == 2
    assert values['plots rows dropped'] == 5
