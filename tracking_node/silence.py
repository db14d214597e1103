# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Why does nothing come in? Who publishes there, and how."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tracking_node.clocks import has_no_clock, NO_CLOCK


class Unheard:
    """Inputs on which somebody publishes, but nobody of the type and QoS that fit; since when."""

    def __init__(self) -> None:
        self.since: dict[str, float] = {}  # by topic [s]

    def look(self, node: Any, subscriptions: Mapping[str, Any], now: float) -> None:
        """Look once more at who is there and who is heard, at the time `now` [s]."""
        for topic, subscription in subscriptions.items():
            if subscription.get_publisher_count() or not node.count_publishers(
                subscription.topic_name
            ):
                self.since.pop(topic, None)
            else:
                self.since.setdefault(topic, now)

    def longer(self, seconds: float, now: float) -> set[str]:
        """Return the topics on which that has been so for longer than `seconds`."""
        return {topic for topic, since in self.since.items() if now - since > seconds}


def explain_silence(node: Any, subscription: Any) -> str:
    """Return what a user must know who waits for output while nothing comes in."""
    topic, wanted = subscription.topic_name, _type_name(subscription.msg_type)
    others = [
        f'{info.node_name} ({info.topic_type}, {_words(info.qos_profile)})'
        for info in node.get_publishers_info_by_topic(topic)
    ]
    there = f'publishers there: {"; ".join(others)}' if others else 'nobody publishes there'
    text = f'nothing has come on {topic} ({wanted}, {_words(subscription.qos_profile)}); {there}'
    return f'{text}; {NO_CLOCK} either' if has_no_clock(node) else text


def _type_name(message: Any) -> str:
    return f'{message.__module__.split(".")[0]}/msg/{message.__name__}'


def _words(qos: Any) -> str:
    return f'{qos.reliability.name.lower()}, {qos.durability.name.lower()}'.replace('_', ' ')
