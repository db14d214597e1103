# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
A ROS node of ours that talks with others in their graph, and waits with a deadline.

Nothing sleeps: whoever waits says for what, messages come in meanwhile, and what did not happen
in time is named in the error. Should the middleware hang as the node goes (``start.py`` of
``tracking_node`` says when), the process ends with a traceback: no Python runs to say more.
"""

from __future__ import annotations

from collections.abc import Callable
import faulthandler
from functools import partial
from itertools import count
import math
import time
from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import try_shutdown

from tracking_tools.node_process import DEADLINE

AGAIN = 1.0  # without an answer for so long, a question is asked once more [s]
TICK = 0.05  # between two looks at whether it is still worth waiting [s]
LONGEST_CLOSE = 30.0  # of the middleware, until the process is ended [s]
MANY = 1000  # messages that may wait to be heard


def _go_on() -> None:
    """Find nothing that makes waiting useless."""


class Peer:
    """
    A node with its own context, in the domain of those it talks with.

    Parameters
    ----------
    domain_id : int
        ROS domain.
    name, namespace : str
        Of the node; topics without a leading slash are in this namespace.
    check : callable, optional
        Raises when waiting has become useless, such as `NodeProcess.check`.

    """

    def __init__(
        self,
        domain_id: int,
        name: str = 'peer',
        namespace: str = '',
        check: Callable[[], object] = _go_on,
    ) -> None:
        self._context, self._check = Context(), check
        rclpy.init(
            args=[], context=self._context, domain_id=domain_id,
            signal_handler_options=SignalHandlerOptions.NO,  # Ctrl-C stays a KeyboardInterrupt
        )  # fmt: skip
        self.node = Node(name, namespace=namespace, context=self._context)
        self._loop = SingleThreadedExecutor(context=self._context)
        self._loop.add_node(self.node)

    def __enter__(self) -> Peer:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Leave the graph."""
        faulthandler.dump_traceback_later(LONGEST_CLOSE, exit=True, file=2)  # captured or not
        try:
            self._loop.shutdown()
            self.node.destroy_node()
            try_shutdown(context=self._context)
        finally:
            faulthandler.cancel_dump_traceback_later()

    def tell(self, kind: Any, topic: str) -> Any:
        """Return a publisher: reliable, keep last 50."""
        return self.node.create_publisher(kind, topic, QoSProfile(depth=50))

    def hear(self, kind: Any, topic: str, into: list[Any], *, raw: bool = False) -> Any:
        """Return a subscription that appends every message, or its bytes, to a list."""
        qos = QoSProfile(depth=MANY)
        return self.node.create_subscription(kind, topic, into.append, qos, raw=raw)

    def spin(self, is_done: Callable[[], object], seconds: float) -> bool:
        """Let messages come until something holds; return whether it did in time."""
        deadline = time.monotonic() + seconds
        while not is_done():
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self._loop.spin_once(timeout_sec=min(left, TICK))
            self._check()
        return True

    def spin_until(
        self, is_done: Callable[[], object], what: str = 'it', deadline: float = DEADLINE
    ) -> None:
        """Let messages come until something holds; raise TimeoutError after `deadline` [s]."""
        if not self.spin(is_done, deadline):
            raise TimeoutError(f'waited {deadline:g} s in vain for {what}; nodes: {self._nodes()}')

    def ask(
        self,
        send: Callable[[int], object],
        is_answered: Callable[[], object],
        what: str = 'an answer',
        again: float = AGAIN,
        deadline: float = DEADLINE,
    ) -> None:
        """
        Send something until it is answered; raise TimeoutError after `deadline` [s].

        A topic may lose messages, above all while two nodes get to know each other, so it is sent
        once more whenever there was no answer for `again` seconds; `send` is given 0, 1, 2, ...
        """
        end, attempts = time.monotonic() + deadline, count()
        while time.monotonic() <= end:
            send(next(attempts))
            if self.spin(is_answered, again):
                return
        raise TimeoutError(f'waited {deadline:g} s in vain for {what}')

    def wait_until_matched(self, *ends: Any, deadline: float = DEADLINE) -> None:
        """Wait until each of these publishers and subscriptions has somebody at the other end."""
        for end in ends:
            others = getattr(end, 'get_subscription_count', None) or end.get_publisher_count
            self.spin_until(others, f'somebody else on {end.topic_name}', deadline)

    def wait_for_node(self, name: str, deadline: float = DEADLINE) -> None:
        """Wait until a node of this full name is in the graph: it can be asked for its topics."""
        self.spin_until(lambda: f'/{name.lstrip("/")}' in self._nodes(), f'node {name}', deadline)

    def _nodes(self) -> list[str]:
        """Return the full names of the other nodes in the graph."""
        own, found = self.node.get_name(), self.node.get_node_names_and_namespaces()
        return sorted(f'{place.rstrip("/")}/{name}' for name, place in found if name != own)

    def call(
        self, kind: Any, service: str, request: Any, deadline: float = DEADLINE,
        again: float = math.inf, before: Callable[[], object] = _go_on,
    ) -> Any:  # fmt: skip
        """
        Return the answer of a service.

        A node that does not know us yet loses its answer. What changes nothing may be asked once
        more, `again` seconds later; or ask `before` what was announced later, and is answered.
        """
        client, asked = self.node.create_client(kind, service), []
        try:
            self.spin_until(client.service_is_ready, f'service {service}', deadline)
            before()
            self.ask(
                lambda _: asked.append(client.call_async(request)),
                lambda: any(future.done() for future in asked),
                f'the answer of {service}', min(again, deadline), deadline,
            )  # fmt: skip
            return next(future.result() for future in asked if future.done())
        finally:
            self.node.destroy_client(client)

    def state(self, node: str, deadline: float = DEADLINE) -> str:
        """Return the state of a lifecycle node: unconfigured, inactive, active or finalized."""
        answer = self.call(GetState, f'{node}/get_state', GetState.Request(), deadline, AGAIN)
        return str(answer.current_state.label)

    def wait_until_active(self, node: str, deadline: float = DEADLINE) -> None:
        """Wait until a lifecycle node is active; raise TimeoutError after `deadline` [s]."""
        end = time.monotonic() + deadline
        while (state := self.state(node, deadline)) != 'active':
            if time.monotonic() > end:
                raise TimeoutError(f'{node} is {state} after {deadline:g} s, not active')
            self.spin(lambda: False, TICK)

    def change_state(self, node: str, transition: str) -> bool:
        """
        Send a lifecycle node through a transition; return whether it succeeded.

        To configure, activate, deactivate, cleanup, unconfigured_shutdown, inactive_shutdown or
        active_shutdown.
        """
        number = getattr(Transition, f'TRANSITION_{transition.upper()}')
        request = ChangeState.Request(transition=Transition(id=number))
        known = partial(self.state, node)
        return bool(self.call(ChangeState, f'{node}/change_state', request, before=known).success)
