# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Time as rclpy has it: types, timers that never stand still, a clock that goes back, ages."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from rclpy.clock import Clock, JumpThreshold
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.time import Time

from msg_adapters.message_types import NANOSECONDS

STOOD = 1.0  # s without a tick after which simulated time stands still
NO_CLOCK = 'use_sim_time is true, but nothing has come on /clock'


def steady_timer(node: Any, period: float, callback: Callable[[], None]) -> Any:
    """Return a timer that runs whether or not /clock does; `period` in s."""
    return node.create_timer(period, callback, clock=Clock(clock_type=ClockType.STEADY_TIME))


def on_clock_going_back(node: Any, callback: Callable[[], None]) -> Any:
    """Call back when simulated time goes back; return a handle to `unregister`."""
    return node.get_clock().create_jump_callback(
        JumpThreshold(min_forward=None, min_backward=Duration(nanoseconds=-1)),
        post_callback=lambda jump: callback() if jump.delta.nanoseconds < 0 else None,
    )


def has_no_clock(node: Any) -> bool:
    """Return whether simulated time is wanted and has not begun."""
    clock = node.get_clock()
    return bool(clock.ros_time_is_active and clock.now().nanoseconds == 0)


def to_time(seconds: float) -> Time:
    """Return a time [s since the epoch] as rclpy has it."""
    return Time(nanoseconds=round(seconds * NANOSECONDS))


def to_duration(seconds: float) -> Duration:
    """Return a duration [s] as rclpy has it."""
    return Duration(nanoseconds=round(seconds * NANOSECONDS))


def age(info: Any) -> float:
    """Return how long ago a message came [s]."""
    return float((time.time_ns() - info['received_timestamp']) / NANOSECONDS)


def arrival_time(node: Any) -> float:
    """Return the time that tells how long an input was silent: simulated, or steady [s]."""
    clock = node.get_clock()
    if clock.ros_time_is_active:
        return float(clock.now().nanoseconds / NANOSECONDS)
    return time.monotonic()


class Pausing:
    """
    The arrival time of a node, which goes on where simulated time stands still for long.

    A recording that is over, or a player that pauses: whatever has waited for more must not wait
    for ever.
    """

    def __init__(self, node: Any) -> None:
        self._node, self._last, self._since = node, -1.0, 0.0

    def now(self) -> float:
        """Return the time [s]."""
        now, steady = arrival_time(self._node), time.monotonic()
        if now != self._last:
            self._last, self._since = now, steady
        stood = steady - self._since
        return now + stood if stood > STOOD else now
