# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is each message really a full turn, as `scan.assembly` says if nobody says otherwise?"""

from __future__ import annotations

from collections.abc import Iterator

from radar_tracker.antenna import Antenna
from tracking_session.doubts import Doubt

_AGREEING = 30  # messages in a row that show it
_MOST = 0.75  # of a turn from message to message


class PartTurns:
    """Watches how often messages come, beside how the antenna is found to turn."""

    def __init__(self) -> None:
        self._count, self._parts = 0, 0.0

    def note(self, antenna: Antenna) -> None:
        """Take note of one message."""
        interval, turn_time = antenna.interval, antenna.turn_time
        is_part = 0.0 < interval < _MOST * turn_time
        self._count = self._count + 1 if is_part else 0
        self._parts = turn_time / interval if is_part else 0.0

    def doubts(self) -> Iterator[Doubt]:
        """Yield what is wrong."""
        if self._count >= _AGREEING:
            yield Doubt(
                'messages are parts of turns',
                f'about {self._parts:.3g} messages come in a turn of the antenna, and '
                'scan.assembly is message, a full turn each: contacts where they are cut are '
                'missed, or start twice. Set it to sector',
            )
