# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How often the tracks are drawn, and what was drawn before."""

from __future__ import annotations

import math
from typing import Any

from msg_adapters.message_types import MessageTypes
from msg_adapters.shapes import erase_all
from tracking_session.session import Session


class Display:
    """Remember what viewers have on their screens."""

    def __init__(self, types: MessageTypes) -> None:
        self._types = types
        self._shown: set[int] = set()
        self._drawn = -math.inf
        self.is_behind = False  # whether there was a scan since the last drawing

    def is_due(self, now: float, rate: float) -> bool:
        """Return whether there is something to draw, at most `rate` times a second."""
        return self.is_behind and rate > 0.0 and now - self._drawn >= 1.0 / rate

    def draw(self, session: Session, now: float, markers: Any) -> Any:
        """Return the MarkerArray of the tracks, at the time `now` [s]."""
        drawing = session.instrument.draw(self._shown, session.header(), markers)
        self._shown = set(session.tracks.id.tolist())
        self._drawn, self.is_behind = now, False
        return drawing

    def erase(self, header: Any) -> Any:
        """Return the MarkerArray that clears the screens."""
        self._shown = set()
        return erase_all(header, self._types)
