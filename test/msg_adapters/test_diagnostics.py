# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Diagnostics are readable."""

from msg_adapters.diagnostics import to_diagnostics


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
