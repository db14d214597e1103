# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a node complains without filling the log: one line per reason and interval, with a count."""

from __future__ import annotations

from collections.abc import Callable
import math
import time


class Throttle:
    """
    Say each reason at once, then at most every `interval` seconds with how often it came.

    Parameters
    ----------
    say : callable
        Takes the line.
    interval : float
        Least time between two lines of one reason [s].
    clock : callable
        Returns a time that never goes back [s].

    """

    def __init__(
        self,
        say: Callable[[str], object],
        interval: float = 5.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._say, self._interval, self._clock = say, interval, clock
        self._said: dict[str, float] = {}
        self._silent: dict[str, int] = {}

    def __call__(self, reason: str, text: str) -> None:
        """Say the text, unless its reason was said a moment ago."""
        now = self._clock()
        if now - self._said.get(reason, -math.inf) < self._interval:
            self._silent[reason] = self._silent.get(reason, 0) + 1
            return
        more = self._silent.pop(reason, 0)
        self._said[reason] = now
        self._say(f'{text} ({more} more like this since the last line)' if more else text)
