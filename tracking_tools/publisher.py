# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a scene is published live, as a radar or a sonar would send it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import signal
from threading import Event

from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.signals import SignalHandlerOptions

from msg_adapters.message_types import rclpy_types
from tracking_node.beginning import begin, leave, made, STOPS
from tracking_tools.scenarios.broadcast import Broadcast, broadcast, Scene
from tracking_tools.scenarios.messages import Sent

# Longest wait for readers to confirm the last messages [s].
_FAREWELL = 2.0
# Longest time until a signal is looked at [s].
_ATTENTION = 0.1


class SimulatedSensor(Node):
    """
    A scene on the air.

    Publishers: those of the broadcast, for a radar ``plots`` and ``truth``, for a sonar
    ``ownship``, ``bearings`` and ``truth`` (reliable, keep last 10). Stamps begin with the first
    message's time and advance with the scene, whatever the rate.

    Parameters
    ----------
    air : Broadcast
        What is sent.
    rate : float
        Times real time.
    wait : bool
        Whether to begin only when somebody listens to the plots.
    about : str
        What it is, for the log.

    """

    def __init__(self, air: Broadcast, rate: float, wait: bool, about: str) -> None:
        super().__init__(f'simulated_{air.sensor}')
        self._air, self._wait, self._classes = air, wait, rclpy_types()
        overrides = QoSOverridingOptions.with_default_policies()
        self._publishers_by_topic = {
            topic: self.create_publisher(
                getattr(self._classes, kind.rpartition('/')[2]), topic, QoSProfile(depth=10),
                qos_overriding_options=overrides,
            )
            for topic, kind in air.types.items()
        }  # fmt: skip
        self.has_finished = False
        self._plots = self._publishers_by_topic[air.topic]
        # Made at the first tick: the stamps begin there.
        self._messages: Iterator[list[Sent]] | None = None
        self.create_timer(air.period / rate, self._tick)
        self.get_logger().info(
            f'{about}: {air.period * air.count:g} s at {rate:g} times real time on '
            f'{self._plots.topic_name}' + (', as soon as somebody listens' if wait else '')
        )

    def _tick(self) -> None:
        if self._messages is None:
            if self._wait and not self._plots.get_subscription_count():
                return
            now = self.get_clock().now().nanoseconds * 1e-9
            self._messages = self._air.messages(self._classes, now)
        sent = next(self._messages, None)
        if sent is None:
            self.has_finished = True
            return
        for topic, msg, _ in sent:
            self._publishers_by_topic[topic].publish(msg)

    def take_leave(self) -> None:
        """Wait until reliable readers have the last messages."""
        for publisher in self._publishers_by_topic.values():
            publisher.wait_for_all_acked(Duration(seconds=_FAREWELL))


def publish(
    scene: Scene,
    ros_arguments: Sequence[str] = (),
    sectors: int = 1,
    rate: float = 1.0,
    wait: bool = False,
) -> int:
    """
    Publish a scene until it ends or a signal comes; returns the exit code.

    Signals are only noted, and looked at between callbacks: rclpy's own handlers end the context
    below a callback that is about to publish, and cannot stand a second signal.
    """
    if not rate > 0.0:
        raise ValueError(f'rate must be above 0, got {rate}')
    air, stop = broadcast(scene, sectors), Event()
    for number in STOPS:
        signal.signal(number, lambda *_: stop.set())
    begin(ros_arguments, SignalHandlerOptions.NO)
    node = made(lambda: SimulatedSensor(air, rate, wait, scene.description))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stop.is_set() or node.has_finished):
            executor.spin_once(timeout_sec=_ATTENTION)
        if node.has_finished:
            node.take_leave()
    finally:
        leave(node, executor)
    return 0
