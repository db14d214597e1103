# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What every node of ours shares: how it starts and stops, and how it opens its topics."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import signal
import sys
from typing import Any

import rclpy
from rclpy.clock import Clock, JumpThreshold
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.time import Time
from rclpy.utilities import ok, remove_ros_args, try_shutdown

from tracking_node.parameter_blocks import foreign_files, missing_files
from tracking_node.parameters import BadParameter

STOPS = (signal.SIGINT, signal.SIGTERM)
LOOK = 1.0  # between two looks at whether the context has ended [s]
DEPTH = 50  # messages of an input that may wait
NANOSECONDS = 1_000_000_000
USAGE = ': no argument of ROS; remap with -r FROM:=TO, set with -p NAME:=VALUE'


class NotStarted(RuntimeError):  # noqa: N818 (a state rather than an error)
    """The node said already why it cannot run."""


def run(make_node: Callable[[], Any], args: Sequence[str] | None = None) -> int:
    """
    Run one node until it is told to stop; return the exit code.

    Parameters
    ----------
    make_node : callable
        Returns the node, ready to spin.
    args : sequence of str, optional
        Command line; that of the process by default.

    Returns
    -------
    int
        0 after SIGINT or SIGTERM, however many; 1 if the node could not start, which is said.

    """
    stops: list[int] = []
    # rclpy ends its context on a signal; Python's own KeyboardInterrupt could come anywhere.
    signal.signal(signal.SIGINT, lambda number, _: stops.append(number))
    wrong = _init(args)
    if wrong:
        print(f'cannot start: {wrong}', file=sys.stderr)
        return 1
    try:
        node = make_node()
        for line in foreign_files(node.get_fully_qualified_name(), args or sys.argv):
            node.get_logger().warning(f'no parameters from {line}')
        _spin(node, stops)
    except ExternalShutdownException:
        pass
    except (BadParameter, NotStarted) as error:
        if not ok():
            return 0  # a signal came while the node was being made
        print(f'cannot start: {error}', file=sys.stderr)
        return 1
    except RuntimeError:
        if ok():
            raise
        # A signal came while the node was talking: rclpy says that its context is gone.
    finally:
        _ignore_stops()
        try_shutdown()
        _ignore_stops()  # rclpy has put back what was before
    return 0


def _init(args: Sequence[str] | None) -> str:
    """Begin to speak ROS; return why that cannot be, '' if it can."""
    given = list(sys.argv if args is None else args)
    for path in missing_files(given):
        return f'there is no parameter file {path}'
    try:
        strange = remove_ros_args(given)[args is None :]
    except RuntimeError as error:
        is_unknown = type(error).__name__ == 'UnknownROSArgsError'  # which rclpy does not export
        return f'{error}{USAGE if is_unknown else ""}'
    if strange:
        return f'unknown arguments {" ".join(strange)}: those of ROS come after --ros-args'
    try:
        rclpy.init(args=None if args is None else given)
    except RuntimeError as error:
        return str(error)
    return ''


def _spin(node: Any, stops: list[int]) -> None:
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    # Of a signal rclpy wakes the executor first and then ends its context, so that one without
    # timers could sleep on for ever.
    steady_timer(node, LOOK, _nothing)
    try:
        if not stops:
            executor.spin()
    finally:
        _ignore_stops()
        executor.shutdown()
        node.destroy_node()


def _nothing() -> None:
    """Only wake."""


def _ignore_stops() -> None:
    for number in STOPS:
        signal.signal(number, signal.SIG_IGN)


def subscribe(node: Any, kind: Any, topic: str, callback: Callable[..., None]) -> Any:
    """Return a subscription that any publisher can serve; users may override its QoS."""
    qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
    options = QoSOverridingOptions.with_default_policies()
    return node.create_subscription(kind, topic, callback, qos, qos_overriding_options=options)


def advertise(node: Any, kind: Any, topic: str) -> Any:
    """Return a lifecycle publisher that any subscriber can hear; users may override its QoS."""
    return node.create_lifecycle_publisher(kind, topic, **_output())


def advertise_always(node: Any, kind: Any, topic: str) -> Any:
    """Return a publisher like that of `advertise`, but of a node in any state."""
    return node.create_publisher(kind, topic, **_output())


def _output() -> dict[str, Any]:
    return {
        'qos_profile': QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE),
        'qos_overriding_options': QoSOverridingOptions.with_default_policies(),
    }


def steady_timer(node: Any, period: float, callback: Callable[[], None]) -> Any:
    """Return a timer that runs whether or not /clock does; `period` in s."""
    return node.create_timer(period, callback, clock=Clock(clock_type=ClockType.STEADY_TIME))


def on_clock_going_back(node: Any, callback: Callable[[], None]) -> Any:
    """Call back when simulated time goes back; return a handle to `unregister`."""
    return node.get_clock().create_jump_callback(
        JumpThreshold(min_forward=None, min_backward=Duration(nanoseconds=-1)),
        post_callback=lambda jump: callback() if jump.delta.nanoseconds < 0 else None,
    )


def to_time(time: float) -> Time:
    """Return a time [s since the epoch] as rclpy has it."""
    return Time(nanoseconds=round(time * NANOSECONDS))


def to_duration(seconds: float) -> Duration:
    """Return a duration [s] as rclpy has it."""
    return Duration(nanoseconds=round(seconds * NANOSECONDS))


def explain_silence(node: Any, subscription: Any) -> str:
    """Return what a user must know who waits for output while nothing comes in."""
    topic, wanted = subscription.topic_name, _type_name(subscription.msg_type)
    others = [
        f'{info.node_name} ({info.topic_type}, {_words(info.qos_profile)})'
        for info in node.get_publishers_info_by_topic(topic)
    ]
    seen = f'publishers there: {"; ".join(others)}' if others else 'nobody publishes there'
    text = f'nothing has come on {topic} ({wanted}, {_words(subscription.qos_profile)}); {seen}'
    clock = node.get_clock()
    if clock.ros_time_is_active and clock.now().nanoseconds == 0:
        text += '; use_sim_time is true, but nothing has come on /clock either'
    return text


def _type_name(message: Any) -> str:
    return f'{message.__module__.split(".")[0]}/msg/{message.__name__}'


def _words(qos: Any) -> str:
    return f'{qos.reliability.name.lower()}, {qos.durability.name.lower()}'.replace('_', ' ')
