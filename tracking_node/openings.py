# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a node opens its topics, and gives all of them back: also when one could not be opened."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from tracking_node.clocks import on_clock_going_back, steady_timer
from tracking_node.endpoints import advertise, advertise_always, subscribe
from tracking_node.transforms import TfTransforms

Callback = Callable[..., Any]


class Openings:
    """What a lifecycle node has opened so far."""

    def __init__(self, node: Any) -> None:
        self._node, self._closing = node, ExitStack()

    def hear(self, kind: Any, topic: str, callback: Callback) -> Any:
        """Return a subscription."""
        return self._keep(
            subscribe(self._node, kind, topic, callback), self._node.destroy_subscription
        )

    def tell(self, kind: Any, topic: str) -> Any:
        """Return a publisher that is silent while the node is not active."""
        return self._keep(
            advertise(self._node, kind, topic), self._node.destroy_lifecycle_publisher
        )

    def tell_always(self, kind: Any, topic: str) -> Any:
        """Return a publisher of a node in any state."""
        return self._keep(advertise_always(self._node, kind, topic), self._node.destroy_publisher)

    def serve(self, kind: Any, name: str, callback: Callback) -> None:
        """Offer a service."""
        self._keep(self._node.create_service(kind, name, callback), self._node.destroy_service)

    def every(self, period: float, callback: Callback) -> Any:
        """Call back at a steady period [s]; return what can be cancelled and reset."""
        timer = steady_timer(self._node, period, callback)
        return self._keep(timer, self._node.destroy_timer)

    def when_clock_goes_back(self, callback: Callback) -> None:
        """Call back when simulated time goes back."""
        self._closing.callback(on_clock_going_back(self._node, callback).unregister)

    def transforms(self) -> TfTransforms:
        """Return what tf2 hears; ValueError where it is not installed."""
        transforms = TfTransforms(self._node)
        self._closing.callback(transforms.close)
        return transforms

    def _keep(self, end: Any, destroy: Callback) -> Any:
        self._closing.callback(destroy, end)
        return end

    def close(self) -> None:
        """Give everything back, the newest first."""
        self._closing.close()
