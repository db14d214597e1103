# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a process begins to speak ROS, or says in words why its arguments do not let it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from tracking_session.parameter_blocks import missing_files

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
