# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if there are few joint events? They are written down one by one.

More events are summed in steps, with fewer additions: ``tables.py`` and ``permutations.py``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, permutations
from math import comb, factorial

import numpy as np

from tracking_core.association.layout import Layout
from tracking_core.association.sums import NEVER
from tracking_core.batches import Floats, Ints

# Products that take less time than the steps do. BLAS takes no second thread for so few, whose
# sums could differ in the last digit: the same input gives the same bytes.
FEW = 2**18


def are_few(layout: Layout) -> bool:
    """Return whether the events of all clusters, made alike in size, are few."""
    rows, columns = int(layout.rows.max()), int(layout.columns.max())
    room = FEW // (rows * columns * len(layout.rows))
    return rows < 6 and _count(rows, columns) <= room


def sum_up_events(layout: Layout, gain: Floats, best_only: bool = False) -> Floats:
    """
    Return the probability of each pair (P,).

    Parameters
    ----------
    layout : Layout
        With few events.
    gain : (P,) array
        Log weight of the pair less that of both its ends in none.
    best_only : bool
        Of the events with the same rows and the same columns only the best may be.

    """
    rows, columns, size = int(layout.rows.max()), int(layout.columns.max()), len(layout.rows)
    where, events = (layout.row, layout.column, layout.cluster), _events(rows, columns)
    table = np.full((rows, columns, size), NEVER)
    table[where] = np.maximum(gain, NEVER)
    log_weight = events.pairs.T @ table.reshape(-1, size)  # (N, C)
    weight = np.exp(log_weight - log_weight.max(axis=0))
    if best_only:
        best = np.maximum.reduceat(weight, events.first, axis=0)
        weight[weight < best.repeat(events.alike, axis=0)] = 0.0
    share = events.pairs @ weight / weight.sum(axis=0)
    return np.asarray(share.reshape(table.shape)[where])


@dataclass(frozen=True)
class _Events:
    """All N joint events of R rows and K columns, permutations of the same ones together."""

    pairs: Floats  # (R K, N) 1 where the event has the pair
    first: Ints  # (sets,) of the events with the same rows and columns
    alike: Ints  # (sets,) number of these


@lru_cache(maxsize=32)
def _events(rows: int, columns: int) -> _Events:
    events: list[list[int]] = []
    first = []
    for pairs in range(rows + 1):
        for row in combinations(range(rows), pairs):
            for column in combinations(range(columns), pairs):
                first.append(len(events))
                events += [
                    [r * columns + c for r, c in zip(row, order, strict=True)]
                    for order in permutations(column)
                ]
    table = np.zeros((rows * columns, len(events)))
    for number, event in enumerate(events):
        table[event, number] = 1.0
    return _Events(table, np.array(first), np.diff(first, append=len(events)))


def _count(rows: int, columns: int) -> int:
    return sum(
        comb(rows, pairs) * comb(columns, pairs) * factorial(pairs) for pairs in range(rows + 1)
    )
