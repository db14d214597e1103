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

from nav_msgs.msg import Odometry
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import try_shutdown
from sensor_msgs.msg import PointCloud2

from tracking_tools.node_process import NodeFailed

DISCOVERY = 15.0  # for the node and us to find each other [s]
ANSWER = 10.0  # ... and for the node to answer one message
AGAIN = 1.0  # without an answer for so long, a message is sent once more
TICK = 0.05  # between two looks at whether the node still runs [s]

Stamp = tuple[int, int]


def stamp_of(cdr: bytes | memoryview) -> Stamp:
    """Return the stamp (sec, nanosec) of a serialised message that begins with a header."""
    order = '<' if cdr[1] & 1 else '>'
    sec, nanosec = struct.unpack_from(f'{order}iI', cdr, 4)
    return sec, nanosec


class Player:
    """
    Plays plots to a tracker.

    Publishers: plots (sensor_msgs/PointCloud2, reliable, keep last 50) and, where it has a name,
    own ship (nav_msgs/Odometry, the same). Subscriber: tracks, as plots.

    Parameters
    ----------
    plots, tracks : str
        Topics.
    context : Context
        Of the ROS domain.
    check : callable
        Raises when waiting has become useless.
    own_ship : str
        Topic, or ''.

    """

    def __init__(
        self,
        plots: str,
        tracks: str,
        context: Context,
        check: Callable[[], object],
        own_ship: str = '',
    ) -> None:
        self._node = Node('recording_player', context=context)
        self._check = check
        self._answers: dict[Stamp, bytes] = {}
        self._newest: bytes | None = None  # odometry of own ship
        self._plots = self._node.create_publisher(PointCloud2, plots, QoSProfile(depth=50))
        self._tracks = self._node.create_subscription(
            PointCloud2, tracks, self._hear, QoSProfile(depth=50), raw=True
        )
        publish = self._node.create_publisher
        self._own_ship = publish(Odometry, own_ship, QoSProfile(depth=50)) if own_ship else None
        self._loop = SingleThreadedExecutor(context=context)
        self._loop.add_node(self._node)

    def _hear(self, cdr: bytes) -> None:
        self._answers[stamp_of(cdr)] = cdr

    def find_tracker(self) -> None:
        """Wait until the tracker and we know each other."""
        if not self._spin(self._is_found, DISCOVERY):
            raise NodeFailed(f'no tracker found within {DISCOVERY:g} s')

    def _is_found(self) -> bool:
        return bool(
            self._plots.get_subscription_count()
            and self._node.count_publishers(self._tracks.topic_name)
            and (self._own_ship is None or self._own_ship.get_subscription_count())
        )

    def wait(self, until: float) -> None:
        """Wait until a time of the monotonic clock [s]."""
        self._spin(lambda: False, until - time.monotonic())

    def tell_own_ship(self, cdr: bytes | memoryview) -> None:
        """Send own ship's odometry, and once more with the next plots that are not answered."""
        self._newest = bytes(cdr)
        self._send_own_ship()

    def _send_own_ship(self) -> None:
        if self._own_ship is not None and self._newest is not None:
            self._own_ship.publish(self._newest)

    def ask(self, cdr: bytes | memoryview) -> bytes | None:
        """Send plots and return the serialised tracks that answer them, None without an answer."""
        stamp = stamp_of(cdr)
        self._answers.clear()
        # A second copy of what did arrive is refused by its stamp, and does no harm.
        for _ in range(round(ANSWER / AGAIN)):
            self._plots.publish(bytes(cdr))
            if self._spin(lambda: stamp in self._answers, AGAIN):
                return self._answers[stamp]
            self._send_own_ship()
        return None

    def _spin(self, is_done: Callable[[], bool], patience: float) -> bool:
        deadline = time.monotonic() + patience
        while not is_done():
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self._loop.spin_once(timeout_sec=min(left, TICK))
            self._check()
        return True

    def close(self) -> None:
        """Leave the graph."""
        self._loop.shutdown()
        self._node.destroy_node()


@contextmanager
def open_player(
    plots: str, tracks: str, domain_id: int, check: Callable[[], object], own_ship: str = ''
) -> Iterator[Player]:
    """Yield a player in this ROS domain; Ctrl-C stays a KeyboardInterrupt."""
    context = Context()
    rclpy.init(
        args=[], context=context, domain_id=domain_id,
        signal_handler_options=SignalHandlerOptions.NO,
    )  # fmt: skip
    player = Player(plots, tracks, context, check, own_ship)
    try:
        yield player
    finally:
        player.close()
        try_shutdown(context=context)
