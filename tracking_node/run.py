# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a process with one node runs: it starts, is told to stop, and ends with an exit code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import signal
import sys
from typing import Any

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.utilities import ok, try_shutdown

from tracking_node.beginning import begin, ignore_stops, leave, made, NotBegun
from tracking_node.clocks import steady_timer
from tracking_node.parameters import BadParameter
from tracking_session.parameter_blocks import foreign_files

LOOK = 1.0  # between two looks at whether the context has ended [s]


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
    given = sys.argv[1:] if args is None else args
    try:
        begin(given)
    except NotBegun as error:
        print(f'cannot start: {error}', file=sys.stderr)
        return 1
    try:
        node = made(make_node)
        for line in foreign_files(node.get_fully_qualified_name(), given):
            node.get_logger().warning(f'no parameters from {line}')
        _spin(node, stops)
    except ExternalShutdownException:
        pass
    except (BadParameter, NotBegun, NotStarted) as error:
        if not ok():
            return 0  # a signal came while the node was being made
        print(f'cannot start: {error}', file=sys.stderr)
        return 1
    except RuntimeError:
        if ok():
            raise
        # A signal came while the node was talking: rclpy says that its context is gone.
    finally:
        ignore_stops()
        try_shutdown()  # where no node was made
        ignore_stops()
    return 0


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
        leave(node, executor)


def _nothing() -> None:
    """Only wake."""
