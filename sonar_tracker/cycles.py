# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are messages that hold a part of a cycle, as one bearing each, put together to cycles?"""

from __future__ import annotations

from dataclasses import replace

from tracking_core.batches import Bearings
from tracking_core.rows import concatenate

_EARLY = 1e-3  # of a cycle: stamps are rounded


class Cycles:
    """
    Collects marks until their cycle is over, which the first message of the next one shows.

    Parameters
    ----------
    period : float
        Of a cycle [s].
    most : int
        Marks of a cycle; with stamps that hardly go on it would never end.

    """

    def __init__(self, period: float, most: int) -> None:
        self._period, self._most = period, most
        self._marks: Bearings | None = None  # of the messages so far, with the stamp of the first

    def add(self, marks: Bearings) -> Bearings | None:
        """Return the cycle before this message, with the stamp of its first one, if it is over."""
        cycle = self._marks
        if cycle is None:
            self._marks = marks
            return None
        age = marks.stamp - cycle.stamp
        if age >= (1.0 - _EARLY) * self._period or len(cycle) + len(marks) > self._most:
            self._marks = marks
            return cycle
        self._marks = replace(concatenate(cycle, marks), stamp=cycle.stamp)
        return None
