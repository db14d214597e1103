# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Why does nothing come in? Who publishes there, and how."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from tracking_node.clocks import has_no_clock, NO_CLOCK


class Lasting:
    """What is so, by name, and since when."""

    def __init__(self) -> None:
        self.since: dict[str, float] = {}  # [s]

    def take(self, names: Iterable[str], now: float) -> None:
        """Take note of what is so at the time `now` [s]; nothing else is."""
        self.since = {name: self.since.get(name, now) for name in names}

    def longer(self, seconds: float, now: float) -> set[str]:
        """Return what has been so for longer than `seconds`."""
        return {name for name, since in self.since.items() if now - since > seconds}


def unheard(node: Any, subscriptions: Mapping[str, Any]) -> Iterator[str]:
    """Yield the topics on which somebody publishes, but nobody of a type and QoS that fit."""
    for topic, subscription in subscriptions.items():
        is_heard = subscription.get_publisher_count()
        if not is_heard and node.count_publishers(subscription.topic_name):
            yield topic


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


def explain_crowd(node: Any, topic: str) -> str:
    """Return who publishes on a topic where one publisher is wanted; `topic` is its full name."""
    there = [
        f'{info.node_namespace.rstrip("/")}/{info.node_name}'
        for info in node.get_publishers_info_by_topic(topic)
    ]
    is_own = topic.startswith(f'{node.get_fully_qualified_name()}/')
    way_out = 'give each node its own name (-r __node:=NAME) or namespace'
    hint = way_out if is_own else 'one is wanted'
    return f'several publishers on {topic}: {", ".join(sorted(there))}; {hint}'


def _type_name(message: Any) -> str:
    return f'{message.__module__.split(".")[0]}/msg/{message.__name__}'


def _words(qos: Any) -> str:
    return f'{qos.reliability.name.lower()}, {qos.durability.name.lower()}'.replace('_', ' ')
