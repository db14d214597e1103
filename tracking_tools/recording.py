# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How a recording is played to a live tracker and its answers are recorded, message by message.

Bytes go through as they are. A topic may lose messages, so each message is played when the one
before it has been answered; nothing is lost, and the answers are those of a replay.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import struct
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger

from msg_adapters.kinds.menu import message_class, POINT_CLOUD
from tracking_tools.node_process import NodeFailed
from tracking_tools.peer import AGAIN, Peer

DISCOVERY = 15.0  # for the node and us to find each other [s]
ANSWER = 10.0  # ... and for the node to answer one message

Stamp = tuple[int, int]


def stamp_of(cdr: bytes | memoryview) -> Stamp:
    """Return the stamp (sec, nanosec) of a serialised message that begins with a header."""
    order = '<' if cdr[1] & 1 else '>'
    sec, nanosec = struct.unpack_from(f'{order}iI', cdr, 4)
    return sec, nanosec


class Player:
    """
    Plays plots to a tracker.

    Publishers: plots (reliable, keep last 50) and, where it has a name, own ship (Odometry, the
    same). Subscriber: tracks. Client: the tracker's reset.

    Parameters
    ----------
    peer : Peer
        Our node in the tracker's graph.
    plots, tracks : str
        Topics.
    own_ship : str
        Topic, or ''.
    kind : str
        Message type of the plots, as the tracker's `input_type`.

    """

    def __init__(
        self,
        peer: Peer,
        plots: str,
        tracks: str,
        own_ship: str = '',
        kind: str = POINT_CLOUD,
    ) -> None:
        self._peer, self._reset = peer, f'{tracks.rpartition("/")[0]}/reset'
        self._is_known = False  # to the tracker, which has been heard
        self._answers: list[bytes] = []
        self._newest: bytes | None = None  # odometry of own ship
        self._plots = peer.tell(message_class(kind), plots)
        self._tracks = peer.hear(PointCloud2, tracks, self._answers, raw=True)
        self._own_ship = peer.tell(Odometry, own_ship) if own_ship else None

    def watch_health(self, topic: str) -> list[Any]:
        """Return a list that grows by every serialised message of diagnostics."""
        return self.watch(DiagnosticArray, topic, raw=True)

    def watch(self, kind: Any, topic: str, raw: bool = False) -> list[Any]:
        """Return a list that grows by every message of another topic, serialised if `raw`."""
        seen: list[Any] = []
        self._peer.hear(kind, topic, seen, raw=raw)
        return seen

    def wait_for(self, is_done: Callable[[], object], what: str) -> None:
        """Wait until something holds, as long as for an answer."""
        self._peer.spin_until(is_done, what, ANSWER)

    def find_tracker(self) -> None:
        """Wait until the tracker and we know each other."""
        ends = [end for end in (self._plots, self._tracks, self._own_ship) if end is not None]
        try:
            self._peer.wait_until_matched(*ends, deadline=DISCOVERY)
        except TimeoutError as error:
            raise NodeFailed(f'no tracker found: {error}') from error

    def wait(self, until: float) -> None:
        """Wait until a time of the monotonic clock [s]."""
        self._peer.spin(lambda: False, until - time.monotonic())

    def tell_own_ship(self, cdr: bytes | memoryview) -> None:
        """Send own ship's odometry, and once more with the next plots that are not answered."""
        self._newest = bytes(cdr)
        self._send_own_ship()

    def _send_own_ship(self) -> None:
        if self._own_ship is not None and self._newest is not None:
            self._own_ship.publish(self._newest)

    def ask(self, cdr: bytes | memoryview) -> bytes:
        """Send plots and return the serialised tracks that answer them."""
        question, stamp = bytes(cdr), stamp_of(cdr)
        self._answers.clear()

        def send(attempt: int) -> None:
            # A second copy of what did arrive is refused by its stamp, and does no harm. But a
            # tracker that did not know us yet has answered nobody: let it begin anew.
            if attempt and not self._is_known:
                self._peer.call(Trigger, self._reset, Trigger.Request(), ANSWER, AGAIN)
            if attempt:
                self._send_own_ship()
            self._plots.publish(question)

        self._peer.ask(
            send,
            lambda: self._answers and stamp_of(self._answers[-1]) == stamp,
            f'tracks of the plots at {stamp[0]}.{stamp[1]:09d}',
            deadline=ANSWER,
        )
        self._is_known = True
        return self._answers[-1]


@contextmanager
def open_player(
    plots: str,
    tracks: str,
    domain_id: int,
    check: Callable[[], object],
    own_ship: str = '',
    kind: str = POINT_CLOUD,
) -> Iterator[Player]:
    """Yield a player in this ROS domain; `check` raises when waiting has become useless."""
    with Peer(domain_id, 'recording_player', check=check) as peer:
        yield Player(peer, plots, tracks, own_ship, kind)
