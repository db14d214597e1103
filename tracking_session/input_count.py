# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What happened to the messages of one topic: used, lost, shed, late, refused."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field


@dataclass
class InputCount:
    """What happened to the messages of one topic."""

    messages: int = 0
    rows: int = 0
    late_used: int = 0  # messages that came after newer ones
    late_dropped: int = 0  # ... and too late to be used
    lost: int = 0  # gaps in the publisher's own numbers
    wait: float = 0.0  # of the last message, for where its sensor was [s]
    in_vain: int = 0  # messages that waited for odometry which did not come
    shed: int = 0  # passed over unread, because the node is too slow and newer ones were there
    publishers: int = 0  # there are at the moment
    refused: Counter[str] = field(default_factory=Counter)  # messages by reason
    dropped: Counter[str] = field(default_factory=Counter)  # rows by reason
    doubtful: Counter[str] = field(default_factory=Counter)  # values by reason
    _number: int | None = None

    def received(self, number: int | None, publishers: int) -> None:
        """
        Count one message.

        Parameters
        ----------
        number : int or None
            The publisher's number of this message, where the transport tells it.
        publishers : int
            With more than one, numbers of several interleave and gaps mean nothing.

        """
        self.messages, self.publishers = self.messages + 1, publishers
        if number is not None and self._number is not None and publishers == 1:
            # A restarted publisher counts from the start again.
            self.lost += max(number - self._number - 1, 0)
        self._number = number

    def ignored(self, number: int | None) -> None:
        """Take note of a message that nobody wanted, so that it does not count as lost."""
        self._number = number

    def values(self, topic: str) -> dict[str, object]:
        """Return all counts under names that begin with the topic."""
        counts = {
            f'{topic} {what}: {reason}': count
            for what in ('refused', 'dropped', 'doubtful')
            for reason, count in sorted(getattr(self, what).items())
        }
        return {
            f'{topic} messages': self.messages,
            f'{topic} rows': self.rows,
            f'{topic} lost': self.lost,
            f'{topic} shed': self.shed,
            f'{topic} publishers': self.publishers,
            f'{topic} late, used': self.late_used,
            f'{topic} late, dropped': self.late_dropped,
            f'{topic} messages refused': self.refused.total(),
            f'{topic} rows dropped': self.dropped.total(),
            **counts,
        }
