# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What waits for a tracker, and what it does not use when it is too slow.

The transport keeps the last messages of a topic. A node that needs longer for each than they are
apart would work on ever older ones, as many behind as the transport keeps; so when the oldest has
waited too long, it is the newest that is used.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tracking_node.clocks import age
from tracking_node.endpoints import DEPTH
from tracking_session.ledger import Ledger

Received = tuple[Any, Any]  # a message, and what the transport knows of it


class Inputs:
    """
    The subscriptions of a tracker, with all that comes counted.

    Parameters
    ----------
    subscriptions : mapping
        By topic.
    ledger : Ledger
        Takes the counts.

    """

    def __init__(self, subscriptions: Mapping[str, Any], ledger: Ledger) -> None:
        self.subscriptions, self._ledger = subscriptions, ledger

    def count(self, topic: str, info: Any) -> None:
        """Count a message, and those before it that were lost."""
        number = info.get('publication_sequence_number')
        publishers = self.subscriptions[topic].get_publisher_count()
        self._ledger.counts[topic].received(number, publishers)

    def ignore(self, topic: str, info: Any) -> None:
        """Take note of a message that came while the node was not active."""
        self._ledger.counts[topic].ignored(info.get('publication_sequence_number'))

    def take_waiting(self, topic: str) -> list[Received]:
        """Take all messages that wait, oldest first, out of the transport."""
        subscription = self.subscriptions[topic]
        waiting: list[Received] = []
        with subscription.handle:
            while len(waiting) < DEPTH:  # a publisher may be faster than we can take
                taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
                if taken is None:
                    break
                waiting.append(taken)
        return waiting

    def freshest(self, topic: str, received: Received, max_delay: float) -> Received:
        """
        Return what was received, or the newest message that waits if this one has waited too long.

        Parameters
        ----------
        topic : str
            Where it came.
        received : tuple
            The message and what is known of it; counted here.
        max_delay : float
            A message may have waited so long [s]; 0: any time.

        """
        self.count(topic, received[1])
        if max_delay == 0.0 or age(received[1]) <= max_delay:
            return received
        for newer in self.take_waiting(topic):
            self._ledger.shed(topic)
            self.count(topic, newer[1])
            received = newer
        return received
