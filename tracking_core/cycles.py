# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are messages that hold a part of a cycle, as one plot each, put together to cycles?"""

from __future__ import annotations

from dataclasses import replace
from typing import Generic, TypeVar

from tracking_core.batches import Bearings, Plots
from tracking_core.rows import concatenate

_EARLY = 1e-3  # of a cycle: stamps are rounded
Rows = TypeVar('Rows', Plots, Bearings)


class Cycles(Generic[Rows]):
    """
    Collects plots or marks until their cycle is over, which the first message of the next shows.

    Parameters
    ----------
    period : float
        Of a cycle [s].
    most : int
        Rows of a cycle; with stamps that hardly go on it would never end.

    """

    def __init__(self, period: float, most: int) -> None:
        self._period, self._most = period, most
        self._rows: Rows | None = None  # of the messages so far, with the stamp of the first

    def add(self, rows: Rows) -> Rows | None:
        """Return the cycle before this message, with the stamp of its first one, if it is over."""
        cycle = self._rows
        if cycle is None:
            self._rows = rows
            return None
        age = rows.stamp - cycle.stamp
        if age >= (1.0 - _EARLY) * self._period or len(cycle) + len(rows) > self._most:
            self._rows = rows
            return cycle
        self._rows = replace(concatenate(cycle, rows), stamp=cycle.stamp)
        return None
