# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What rclpy leaves out when a lifecycle node is asked for what it cannot do."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
import traceback
from typing import Any


def refuse_wrong_transitions(node: Any) -> None:
    """Let a node refuse a transition that its state does not allow; rclpy would end the node."""
    service = node._service_change_state  # there is no public way to it
    change = service.callback

    def refuse_or_change(request: Any, response: Any) -> Any:
        try:
            return change(request, response)
        except RuntimeError:
            if not node.context.ok():
                raise  # a signal came meanwhile
            _, state = node._state_machine.current_state
            wanted = request.transition.label or request.transition.id
            node.get_logger().warning(f'{state}: there is no transition {wanted} from here')
            response.success = False
            return response

    service.callback = refuse_or_change


def reported(step: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """Log what goes wrong in a step of the lifecycle: rclpy calls on_error without a word."""

    @wraps(step)
    def run(node: Any, state: Any) -> Any:
        try:
            return step(node, state)
        except Exception:
            if node.context.ok():
                node.get_logger().error(f'{step.__name__} failed:\n{traceback.format_exc()}')
            raise

    return run
