# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What was refused or dropped: counted for the diagnostics, said to the user now and then."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol

from tracking_session.doubts import Doubt
from tracking_session.input_count import InputCount
from tracking_session.throttle import Throttle


class Log(Protocol):
    """Where a user reads; the loggers of rclpy and of Python are such."""

    def info(self, message: str, /) -> Any:
        """Say what happens."""

    def warning(self, message: str, /) -> Any:
        """Say what is wrong."""


class Ledger:
    """
    Count and complain.

    Parameters
    ----------
    topics : str
        Names of the inputs, separated by blanks.
    say : callable
        Takes a line for the user.

    """

    def __init__(self, topics: str, say: Callable[[str], object]) -> None:
        self.counts = {topic: InputCount() for topic in topics.split()}
        self.failures: Counter[str] = Counter()  # of what is no input, by what failed
        self.warn, self._say = Throttle(say), say
        self._doubted: set[str] = set()

    def refuse(self, topic: str, reason: str, error: object) -> None:
        """Count a message that cannot be used; `reason` has no values in it."""
        self.counts[topic].refused[reason] += 1
        self.warn(f'{topic}: {reason}', f'{topic} message refused: {error}')

    def fail(self, what: str, error: object) -> None:
        """Count and tell what could not be done; `what` has no values in it."""
        self.failures[what] += 1
        self.warn(what, f'{what}: {error}')

    def doubt(self, doubts: Iterable[Doubt]) -> None:
        """Tell each doubt once."""
        for what, text in doubts:
            if what not in self._doubted:
                self._doubted.add(what)
                self._say(text)

    def unused(self, topic: str, reason: str, text: str) -> None:
        """Count a value of a message that is not used, and tell it once."""
        self.counts[topic].doubtful[reason] += 1
        self.doubt([Doubt(f'{topic}: {reason}', text)])

    def shed(self, topic: str) -> None:
        """Count a message that is passed over for a newer one."""
        self.counts[topic].shed += 1
        self.warn(f'{topic} shed', f'too slow for these {topic}: only the newest are used')

    def use(
        self, topic: str, rows: int, dropped: Mapping[str, int], doubtful: Mapping[str, int]
    ) -> None:
        """Count the rows of a message that is used, and those left out, by reason."""
        count = self.counts[topic]
        count.rows += rows
        count.dropped.update(dropped)
        count.doubtful.update(doubtful)
        total = rows + sum(dropped.values())
        for reason, number in dropped.items():
            self.warn(reason, f'{number} of {total} {topic} dropped: {reason}')
        for reason, number in doubtful.items():
            self.warn(reason, f'{number} {topic} with values that are not used: {reason}')
