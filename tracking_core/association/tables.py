# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are joint events summed up? Tables over sets of rows, one for each column.

Columns are handed out one after the other. All that matters of the past is which rows are
taken, so a table has one entry for each set of rows (a bit mask): the sum over all ways to get
there. All terms are positive: nothing cancels. The arithmetic is a parameter: sums and products,
or the same in logarithms for weights whose products leave the range of floating point.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tracking_core.batches import Floats, Ints

# No factor is above 1, so what underflows is an event below 1e-307: nothing, if the sum of all
# events is above this.
SAFE_SUM = 1e-280
AT_ONCE = 2**14  # entries of one table times rows: up to here all rows go in one array


@dataclass(frozen=True)
class Arithmetic:
    """What stands for sums and products in the tables."""

    add: np.ufunc
    multiply: np.ufunc
    zero: float
    one: float
    of_log: Callable[[Floats], Floats]
    to_log: Callable[[Floats], Floats]
    share: Callable[[Floats, Floats], Floats]  # part of a sum and the sum, to probability


def _share(part: Floats, total: Floats) -> Floats:
    return part / np.maximum(total, SAFE_SUM)


def _safe_log(total: Floats) -> Floats:
    return np.asarray(np.log(np.maximum(total, SAFE_SUM)))


def _log_share(part: Floats, total: Floats) -> Floats:
    return np.asarray(np.exp(part - total))


LINEAR = Arithmetic(np.add, np.multiply, 0.0, 1.0, np.exp, _safe_log, _share)
LOGARITHMIC = Arithmetic(np.logaddexp, np.add, -np.inf, 0.0, np.positive, np.positive, _log_share)


def sum_events(
    weight: Floats, free_row: Floats, free_column: Floats, arithmetic: Arithmetic
) -> tuple[Floats, Floats]:
    """
    Sum over the joint events of C clusters with R rows and K columns.

    Parameters
    ----------
    weight : (R, K, C) array
        Weight of the pair of a row and a column.
    free_row, free_column : (R, C) and (K, C) arrays
        Weight of a row or column that is in no pair.
    arithmetic : Arithmetic
        Of the weights and of the results.

    Returns
    -------
    tuple of (R, K, C) and (C,) arrays
        Sum of the events that have this pair, and of all events.

    """
    rows, columns, size = weight.shape
    # From the first column to the last and from the last to the first, side by side. The tables
    # on the way back are over the sets of rows that are still free, not of those taken. The last
    # entry is for no set and stays zero.
    tables = np.full((columns + 1, (1 << rows) + 1, 2 * size), arithmetic.zero)
    tables[0, 0, :size] = arithmetic.one
    tables[0, :-1, size:] = _idle(free_row, arithmetic)
    both = np.concatenate([weight, weight[:, ::-1]], axis=2)
    free = np.hstack([free_column, free_column[::-1]])
    at_once = rows * tables[0].size <= AT_ONCE
    (_fill_at_once if at_once else _fill)(tables, both, free, arithmetic)
    past, future = tables[:-1, :-1, :size], tables[-2::-1, -2::-1, size:]
    ways = (_ways_at_once if at_once else _ways)(past, future, rows, arithmetic)
    return arithmetic.multiply(ways, weight), tables[-1, -2, size:]


def _split(tables: Floats, row: int) -> Floats:
    """Return (K, hi, 2, lo, C): the sets without the row at 0, with it at 1 of the third axis."""
    return tables.reshape(len(tables), -1, 2, 1 << row, tables.shape[-1])


def _idle(free_row: Floats, arithmetic: Arithmetic) -> Floats:
    """Return (2^R, C): the weight that all rows of the set stay in no pair."""
    table = np.full((1, 1 << len(free_row), free_row.shape[1]), arithmetic.one)
    for row, free in enumerate(free_row):
        arithmetic.multiply(_split(table, row)[:, :, 1], free, out=_split(table, row)[:, :, 1])
    return np.asarray(table[0])


def _fill(tables: Floats, weight: Floats, free_column: Floats, arithmetic: Arithmetic) -> None:
    """Compute table k + 1 from table k: column k stays free or takes one of the free rows."""
    halves = [_split(tables[:, :-1], row) for row in range(len(weight))]
    ends = [(half[:, :, 0], half[:, :, 1]) for half in halves]
    used = np.any(weight > arithmetic.zero, axis=2)
    for k, free in enumerate(free_column):
        arithmetic.multiply(tables[k], free, out=tables[k + 1])
        for row in np.flatnonzero(used[:, k]):
            without, having = ends[row][0][k], ends[row][1][k + 1]
            arithmetic.add(having, arithmetic.multiply(without, weight[row, k]), out=having)


def _ways(past: Floats, future: Floats, rows: int, arithmetic: Arithmetic) -> Floats:
    """Return (R, K, C): all that may be before and after column k takes the row."""
    ways = np.empty((rows, len(past), past.shape[-1]))
    for row in range(rows):
        product = arithmetic.multiply(_split(past, row)[:, :, 0], _split(future, row)[:, :, 1])
        product = product.reshape(len(past), -1, past.shape[-1])
        arithmetic.add.reduce(product, axis=1, out=ways[row])
    return ways


@lru_cache(maxsize=32)
def _sets(rows: int) -> tuple[Ints, Ints, Ints]:
    """
    Return what becomes of the sets (2^R) when a row leaves or joins.

    Every set without each row (R, 2^R), -1 where it does not have the row; the sets without it
    (R, 2^(R - 1)); the same with it.
    """
    sets, row = np.arange(1 << rows), 1 << np.arange(rows)[:, None]
    has = (sets & row) > 0
    lacking = np.nonzero(~has)[1].reshape(rows, -1)
    return np.where(has, sets ^ row, -1), lacking, lacking | row


def _fill_at_once(
    tables: Floats, weight: Floats, free_column: Floats, arithmetic: Arithmetic
) -> None:
    """Do what `_fill` does, all rows in one: sooner done where tables are small."""
    without = _sets(len(weight))[0]
    for k, free in enumerate(free_column):
        taken = arithmetic.multiply(tables[k][without], weight[:, k, None])  # (R, 2^R, C)
        taken = arithmetic.add.reduce(taken, axis=0)
        arithmetic.add(taken, arithmetic.multiply(tables[k, :-1], free), out=tables[k + 1, :-1])


def _ways_at_once(past: Floats, future: Floats, rows: int, arithmetic: Arithmetic) -> Floats:
    """Do what `_ways` does, all rows in one."""
    _, lacking, having = _sets(rows)
    product = arithmetic.multiply(past[:, lacking], future[:, having])  # (K, R, 2^(R - 1), C)
    return np.asarray(arithmetic.add.reduce(product, axis=2).swapaxes(0, 1))
