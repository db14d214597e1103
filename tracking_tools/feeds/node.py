# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The plots of a feed, published as they come from UDP or from a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import chain, pairwise
import math
import signal
import socket
from threading import Event
import time
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import PointCloud2

from tracking_node.beginning import begin, leave, made, STOPS
from tracking_tools.feeds.feed import describe, Feed
from tracking_tools.feeds.sources import LARGEST

REPORT = 10.0  # between two lines on what was left out [s]
FAREWELL = 2.0  # for readers to confirm the last plots [s]
ATTENTION = 0.05  # between two looks for a listener [s]


class FeedNode(Node):
    """
    One sender on the air.

    Publisher: ``plots`` (sensor_msgs/PointCloud2, reliable, keep last 10).

    Parameters
    ----------
    name : str
        Of the format.
    feed : Feed
        Makes the messages.

    """

    def __init__(self, name: str, feed: Feed) -> None:
        super().__init__(f'{name}_feed')
        self.feed, self._told, self._said = feed, time.monotonic(), ''
        self._plots = self.create_publisher(
            PointCloud2, 'plots', QoSProfile(depth=10),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )  # fmt: skip

    def has_listener(self) -> bool:
        """Return whether somebody hears the plots."""
        return bool(self._plots.get_subscription_count())

    def await_listener(self, stop: Event) -> None:
        """Wait until somebody hears the plots, which is said, or it is time to stop."""
        if not self.has_listener():
            topic = self._plots.topic_name
            self.get_logger().info(f'begins as soon as somebody listens on {topic}')
        while not self.has_listener() and not stop.wait(ATTENTION):
            pass

    def tell(self, msg: Any) -> None:
        """Publish plots."""
        self._plots.publish(msg)

    def report(self) -> None:
        """Say now and then what became of the reports, if that is news."""
        now = time.monotonic()
        if now - self._told <= REPORT:
            return
        self._told, before, self._said = now, self._said, describe(self.feed)
        if self._said == before:
            return
        if self.feed.told:
            self.get_logger().info(self._said)
        else:
            self.get_logger().warning(f'nothing to publish yet; {self._said}')

    def take_leave(self) -> None:
        """Say what became of all reports, once reliable readers have the last plots."""
        self._plots.wait_for_all_acked(Duration(seconds=FAREWELL))
        self.get_logger().info(describe(self.feed))


def publish(
    name: str,
    feed: Feed,
    chunks: Iterable[bytes] | socket.socket,
    ros_arguments: Sequence[str],
    rate: float,
) -> int:
    """
    Publish a socket's datagrams as they come, or chunks of a file at their times; return 0.

    Parameters
    ----------
    name : str
        Of the format.
    feed : Feed
        Makes the messages.
    chunks : socket, or iterable of bytes
        Where they come from.
    ros_arguments : sequence of str
        Those after ``--ros-args``.
    rate : float
        Times real time, for a file.

    """
    stop = Event()
    for number in STOPS:
        signal.signal(number, lambda *_: stop.set())
    begin(ros_arguments, SignalHandlerOptions.NO)
    node = made(lambda: FeedNode(name, feed))
    try:
        if isinstance(chunks, socket.socket):
            _hear(node, chunks, stop.is_set)
        else:
            _play(node, chunks, rate, stop)
        node.take_leave()
    finally:
        leave(node)
    return 0


def _hear(node: FeedNode, hearing: socket.socket, is_over: Callable[[], bool]) -> None:
    while not is_over():
        try:
            data = hearing.recv(LARGEST)
        except TimeoutError:
            told = node.feed.overdue(time.time())
        else:
            now = time.time()
            node.feed.clock.set(now)
            told = node.feed.take(data, now)
        if told is not None:
            node.tell(told[1])
        node.report()


def _play(node: FeedNode, chunks: Iterable[bytes], rate: float, stop: Event) -> None:
    node.await_listener(stop)
    begun, first, end = time.monotonic(), None, (math.inf, None)
    for (stamp, msg), (following, _) in pairwise(chain(node.feed.messages(chunks), [end])):
        due = min(stamp, following)  # a damaged time may be hours ahead
        first = due if first is None else first
        if stop.wait(max(begun + (due - first) / rate - time.monotonic(), 0.0)):
            return
        node.tell(msg)
        node.report()
