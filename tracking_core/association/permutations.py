# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which permutation is the best for each set of rows and of columns, and what do these sum to?

Events with the same rows and the same columns in pairs differ only in who has whom. The best of
them is found set by set: the last row of the set takes one column of the other set, and the rest
is a set solved before. The share of each pair in the sum then follows the choices back.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations
from math import comb

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.association.layout import batches, lay_out, split
from tracking_core.batches import Floats, Ints

MEMORY = 2**20  # entries of the largest array: 8 MB
PADDING = 10_000  # comparisons that cost less than a batch of their own


def sum_up_best(contest: Contest) -> Floats:
    """
    Return the probability of each pair (P,) if of all permutations only the best may be.

    References
    ----------
    [BLOM00], the sums of JPDA*.

    """
    layout, probability = lay_out(contest), np.empty(len(contest.track))
    for batch in batches(layout, np.ones(len(layout.rows), np.bool_), comparisons, PADDING):
        largest = comparisons(int(layout.rows[batch].max()), int(layout.columns[batch].max()))
        for part in split(batch, MEMORY // largest):
            gain, pairs, where = layout.tables(part, -np.inf)
            gain[where] = contest.gain[pairs]
            probability[pairs] = share_of_best(gain)[where]
    return probability


def comparisons(rows: int, columns: int) -> int:
    """Return how many ways to reach a set of rows and columns are compared in all."""
    return rows * comb(rows + columns - 1, rows) if rows else 0


def share_of_best(gain: Floats) -> Floats:
    """
    Share out the sum over all sets of rows and of columns, the best permutation of each.

    Parameters
    ----------
    gain : (R, K, C) array
        Log weight of each pair in C clusters, R at most K, less that of row and column in no pair.

    Returns
    -------
    (R, K, C) array
        The part of the sum that has the pair.

    """
    values, choices = [np.zeros((1, 1, gain.shape[2]))], []
    for size in range(1, len(gain) + 1):
        value, choice = _best(gain, values[-1], size)
        values.append(value)
        choices.append(choice)
    top = np.max([value.max(axis=(0, 1)) for value in values], axis=0)
    weights = [np.exp(value - top) for value in values]
    total = np.sum([weight.sum(axis=(0, 1)) for weight in weights], axis=0)
    share, flow = np.zeros(gain.shape), weights[-1] / total
    for size in range(len(gain), 0, -1):
        flow = _follow(flow, choices[size - 1], size, share) + weights[size - 1] / total
    return share


def _best(gain: Floats, smaller: Floats, size: int) -> tuple[Floats, Ints]:
    """
    Return the weight (S, U, C) of the best permutation, and which column its last row has.

    `smaller` (S', U', C) is the same for sets with one row and one column less.
    """
    rows, fewer_rows = _subsets(gain.shape[0], size)
    columns, fewer_columns = _subsets(gain.shape[1], size)
    last, rest = rows[:, -1, None], fewer_rows[:, -1, None]
    value = smaller[rest, fewer_columns[:, 0]] + gain[last, columns[:, 0]]
    choice = np.zeros(value.shape, np.int64)
    for taken in range(1, size):  # members of the set of columns
        other = smaller[rest, fewer_columns[:, taken]] + gain[last, columns[:, taken]]
        choice[other > value] = taken
        np.maximum(value, other, out=value)
    return value, choice


def _follow(flow: Floats, choice: Ints, size: int, share: Floats) -> Floats:
    """Add what flows (S, U, C) through each choice to its pair; return it for the sets left."""
    R, K, C = share.shape
    rows, fewer_rows = _subsets(R, size)
    columns, fewer_columns = _subsets(K, size)
    last, rest = rows[:, -1, None, None], fewer_rows[:, -1, None, None]
    U, cluster = np.arange(len(columns))[:, None], np.arange(C)
    pair = (last * K + columns[U, choice]) * C + cluster
    share += np.bincount(pair.ravel(), flow.ravel(), share.size).reshape(share.shape)
    shape = (comb(R, size - 1), comb(K, size - 1), C)
    left = (rest * shape[1] + fewer_columns[U, choice]) * C + cluster
    onward = np.bincount(left.ravel(), flow.ravel(), shape[0] * shape[1] * C)
    return np.asarray(onward.reshape(shape), np.float64)


@lru_cache(maxsize=128)
def _subsets(count: int, size: int) -> tuple[Ints, Ints]:
    """
    Return all sets of so many out of `count`, and what each is without each of its members.

    The members (N, size), ascending, and positions (N, size) among the sets of one less.
    """
    members = np.array(list(combinations(range(count), size)), np.int64)
    members = members.reshape(comb(count, size), size)
    if size == 0:
        return members, members
    fewer = (1 << _subsets(count, size - 1)[0]).sum(axis=1)  # as bit masks
    bits = 1 << members
    order = np.argsort(fewer)
    without = np.searchsorted(fewer, bits.sum(axis=1, keepdims=True) - bits, sorter=order)
    return members, order[without]
