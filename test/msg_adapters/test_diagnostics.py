# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Counts are right and readable."""

from msg_adapters.diagnostics import to_diagnostics
from msg_adapters.input_count import InputCount


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


def test_status_has_level_and_text(types):
    """Values become text, floats short."""
    header = types.header(1.0, '')
    values = {'tracks': 3, 'step time [s]': 0.00123456}
    (status,) = to_diagnostics(
        'radar', 'WARN', 'no plots', values=values, header=header, types=types
    ).status
    assert status.level == types.DiagnosticStatus.WARN
    assert [(v.key, v.value) for v in status.values] == [
        ('tracks', '3'), ('step time [s]', '0.001235'),
    ]  # fmt: skip
