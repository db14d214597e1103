# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""`~/markers`: how often the tracks are drawn, and what was drawn before."""

from __future__ import annotations

import math
import time
from typing import Any

from visualization_msgs.msg import MarkerArray

from msg_adapters.message_types import MessageTypes
from msg_adapters.shapes import erase_all
from tracking_node.endpoints import wait_for_readers
from tracking_node.openings import Openings
from tracking_session.session import Session


class Display:
    """Remember what viewers have on their screens."""

    def __init__(self, types: MessageTypes) -> None:
        self._types = types
        self._shown: set[int] = set()
        self._drawn = -math.inf
        self._is_first = True  # what another run of the node has drawn is there still
        self.is_behind = False  # whether there was a scan since the last drawing

    def is_due(self, now: float, rate: float) -> bool:
        """Return whether there is something to draw, at most `rate` times a second."""
        return self.is_behind and rate > 0.0 and now - self._drawn >= 1.0 / rate

    def draw(self, session: Session, now: float, markers: Any) -> Any:
        """Return the MarkerArray of the tracks, at the time `now` [s]."""
        header = session.header()
        drawing = session.instrument.draw(self._shown, header, markers)
        if self._is_first:
            drawing.markers = [*self.erase(header).markers, *drawing.markers]
        self._shown = set(session.tracks.id.tolist())
        self._drawn, self.is_behind = now, False
        return drawing

    def erase(self, header: Any) -> Any:
        """Return the MarkerArray that clears the screens."""
        self._shown, self._is_first, self.is_behind = set(), False, False
        return erase_all(header, self._types)


class MarkerTopic:
    """
    `~/markers`, while somebody looks.

    Parameters
    ----------
    openings : Openings
        Of the node; they close the topic.
    types : MessageTypes
        Classes of the messages.

    """

    def __init__(self, openings: Openings, types: MessageTypes) -> None:
        self._topic, self._display = openings.tell(MarkerArray, '~/markers'), Display(types)

    def follow(self, session: Session, markers: Any) -> None:
        """Draw what a scan has changed, now or when it is due; `markers` says how."""
        self._display.is_behind = True
        self.draw(session, markers)

    def draw(self, session: Session, markers: Any) -> None:
        """Draw if somebody looks and it is due."""
        now, is_seen = time.monotonic(), self._topic.get_subscription_count()
        if is_seen and session.stamp is not None and self._display.is_due(now, markers.rate):
            self._topic.publish(self._display.draw(session, now, markers))

    def clear(self, session: Session) -> None:
        """Clear the screens; nothing is due until the next scan."""
        if session.stamp is not None:
            self._topic.publish(self._display.erase(session.header()))

    def take_leave(self) -> None:
        """Let viewers have what was published last before the topic goes."""
        wait_for_readers(self._topic)
