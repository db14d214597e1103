# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a scenario is published live, as a radar would send it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import signal
from threading import Event

import rclpy
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import try_shutdown
from sensor_msgs.msg import PointCloud2

from msg_adapters.message_types import rclpy_types
from tracking_tools.scenarios.messages import PLOTS, send, Sent, TRUTH
from tracking_tools.scenarios.plots import Scenario

# Longest wait for readers to confirm the last messages [s].
_FAREWELL = 2.0
# Longest time until a signal is looked at [s].
_ATTENTION = 0.1


class SimulatedRadar(Node):
    """
    A scenario on the air.

    Publishers: ``plots`` and ``truth`` (sensor_msgs/PointCloud2, reliable, keep last 10). Stamps
    begin with the first message's time and advance with the scenario, whatever the rate.

    Parameters
    ----------
    scenario : Scenario
    sectors : int
        Messages in a turn.
    rate : float
        Times real time.
    wait : bool
        Whether to begin only when somebody listens to ``plots``.

    """

    def __init__(self, scenario: Scenario, sectors: int, rate: float, wait: bool) -> None:
        super().__init__('simulated_radar')
        self._scenario, self._sectors, self._wait = scenario, sectors, wait
        overrides = QoSOverridingOptions.with_default_policies()
        self._publishers_by_topic = {
            topic: self.create_publisher(
                PointCloud2, topic, QoSProfile(depth=10), qos_overriding_options=overrides
            )
            for topic in (PLOTS, TRUTH)
        }
        self.has_finished = False
        period = scenario.radar.period / sectors / rate
        self._messages: Iterator[list[Sent]] = iter(
            ()
        )  # made at the first tick: the stamps begin there
        self._has_begun = False
        self.create_timer(period, self._tick)
        where = self._publishers_by_topic[PLOTS].topic_name
        self.get_logger().info(
            f'{scenario.description}: {scenario.duration:g} s at {rate:g} times real time on '
            f'{where}' + (', as soon as somebody listens' if wait else '')
        )

    def _tick(self) -> None:
        if not self._has_begun:
            if self._wait and not self._publishers_by_topic[PLOTS].get_subscription_count():
                return
            self._has_begun = True
            now = self.get_clock().now().nanoseconds * 1e-9
            self._messages = send(self._scenario, rclpy_types(), self._sectors, now)
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
    scenario: Scenario,
    ros_arguments: Sequence[str] = (),
    sectors: int = 1,
    rate: float = 1.0,
    wait: bool = False,
) -> int:
    """
    Publish a scenario until it ends or a signal comes; returns the exit code.

    Signals are only noted, and looked at between callbacks: rclpy's own handlers end the context
    below a callback that is about to publish, and cannot stand a second signal.
    """
    if not rate > 0.0:
        raise ValueError(f'rate must be above 0, got {rate}')
    stop = Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    rclpy.init(args=list(ros_arguments), signal_handler_options=SignalHandlerOptions.NO)
    node = SimulatedRadar(scenario, sectors, rate, wait)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stop.is_set() or node.has_finished):
            executor.spin_once(timeout_sec=_ATTENTION)
        if node.has_finished:
            node.take_leave()
    finally:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)  # Python takes its handlers away as it exits
        executor.shutdown()
        node.destroy_node()
        try_shutdown()
    return 0
