# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""With which quality of service does every node of ours open its topics?"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

DEPTH = 50  # messages of an input that may wait
FAREWELL = 0.5  # s, within which readers should have the last message


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


def wait_for_readers(publisher: Any) -> None:
    """Wait until reliable readers have what was published last, but not long."""
    publisher.wait_for_all_acked(Duration(seconds=FAREWELL))
