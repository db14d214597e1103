# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if a cluster has few joint events? They are written down one by one.

More events are summed in steps, with fewer additions: ``tables.py`` and ``permutations.py``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, permutations
from math import comb, factorial

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.association.layout import batches, lay_out, split
from tracking_core.association.sums import NEVER
from tracking_core.batches import Bools, Floats, Ints

# Products that take less time than the steps do. BLAS takes no second thread for so few, whose
# sums could differ in the last digit: the same input gives the same bytes.
MOST_PRODUCTS = 2**18
PADDING = 2**16  # products that take less time than a batch of their own
MOST_COLUMNS = np.array([0, 0, 8, 8, 6, 5, 0])  # of a cluster with so many rows


def have_few(tracks: Ints, plots: Ints) -> Bools:
    """Return which clusters, of so many tracks and plots each, have few events."""
    rows, columns = np.minimum(tracks, plots), np.maximum(tracks, plots)
    return np.asarray(columns <= MOST_COLUMNS[np.minimum(rows, len(MOST_COLUMNS) - 1)])


def sum_up_events(contest: Contest, best_only: bool = False) -> Floats:
    """
    Return the probability of each pair (P,) in clusters that have few events.

    If `best_only`, of the events with the same tracks and the same plots only the best may be.
    """
    layout, probability = lay_out(contest), np.empty(len(contest.track))
    for batch in batches(layout, np.ones(len(layout.rows), np.bool_), products, PADDING):
        largest = products(int(layout.rows[batch].max()), int(layout.columns[batch].max()))
        for part in split(batch, MOST_PRODUCTS // largest):
            table, pairs, where = layout.tables(part, NEVER)
            table[where] = np.maximum(contest.gain[pairs], NEVER)
            probability[pairs] = _share(table, best_only)[where]
    return probability


def _share(table: Floats, best_only: bool) -> Floats:
    """Return the share (R, K, C) of each pair in all events of its cluster."""
    rows, columns, size = table.shape
    events = _events(rows, columns)
    log_weight = events.pairs.T @ table.reshape(-1, size)  # (N, C)
    if best_only:
        best = np.maximum.reduceat(log_weight, events.first, axis=0)
        weight = np.exp(best - best.max(axis=0)).repeat(events.alike, axis=0)
        weight *= log_weight >= best.repeat(events.alike, axis=0)
    else:
        weight = np.exp(log_weight - log_weight.max(axis=0))
    share = events.pairs @ weight / weight.sum(axis=0)
    return np.asarray(share.reshape(table.shape))


@dataclass(frozen=True)
class _Events:
    """All N joint events of R rows and K columns, permutations of the same ones together."""

    pairs: Floats  # (R K, N) 1 where the event has the pair
    first: Ints  # (sets,) of the events with the same rows and columns
    alike: Ints  # (sets,) number of these


@lru_cache(maxsize=64)
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


@lru_cache(maxsize=1024)
def products(rows: int, columns: int) -> int:
    """Return events times pairs that each might have."""
    events = sum(
        comb(rows, pairs) * comb(columns, pairs) * factorial(pairs) for pairs in range(rows + 1)
    )
    return events * rows * columns
