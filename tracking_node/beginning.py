# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a process begins to speak ROS, or says in words why it cannot; and how it leaves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import signal
from typing import Any

import rclpy
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args, try_shutdown

from tracking_node.start import limit_end
from tracking_session.parameter_blocks import missing_files

STOPS = (signal.SIGINT, signal.SIGTERM)
USAGE = ': no argument of ROS; remap with -r FROM:=TO, set with -p NAME:=VALUE'


class NotBegun(ValueError):  # noqa: N818 (it is the arguments that are bad)
    """Arguments that ROS cannot take; says which and why."""


def begin(
    arguments: Sequence[str], handlers: SignalHandlerOptions = SignalHandlerOptions.ALL
) -> None:
    """
    Initialise rclpy's default context.

    Parameters
    ----------
    arguments : sequence of str
        Those of the process, without its name.
    handlers : SignalHandlerOptions
        Which signals rclpy takes.

    Raises
    ------
    NotBegun
        For an argument that is not of ROS, or that ROS cannot read.

    """
    given = list(arguments)
    for path in missing_files(given):
        raise NotBegun(f'there is no parameter file {path}')
    try:
        strange = remove_ros_args(given)
        if strange:
            raise NotBegun(
                f'unknown arguments {" ".join(strange)}: those of ROS come after --ros-args'
            )
        rclpy.init(args=given, signal_handler_options=handlers)
    except RuntimeError as error:
        is_unknown = type(error).__name__ == 'UnknownROSArgsError'  # which rclpy does not export
        raise NotBegun(f'{error}{USAGE if is_unknown else ""}') from error


def made(make_node: Callable[[], Any]) -> Any:
    """Return a new node; NotBegun where a parameter of rclpy's own has a value of another type."""
    try:
        return make_node()
    except InvalidParameterTypeException as error:  # as of use_sim_time:=1
        raise NotBegun(str(error)) from error


def leave(node: Any, executor: Any = None) -> None:
    """Take a node, and who spins it, out of the graph for good, in time; signals are too late."""
    ignore_stops()
    limit_end()
    try:
        if executor is not None:
            executor.shutdown()
        node.destroy_node()
        try_shutdown()
    finally:
        signal.alarm(0)
        ignore_stops()  # rclpy has put back what was before


def ignore_stops() -> None:
    """Hear no request to end: there is nothing left to do, and Python takes its handlers away."""
    for number in STOPS:
        signal.signal(number, signal.SIG_IGN)
