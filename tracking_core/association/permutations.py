# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which permutation is the best for each set of rows and of columns, and what do these sum to?

Events with the same rows and the same columns in pairs differ only in who has whom. The best of
them is found set by set: the last row of the set takes one column of the other set, and the rest
is a set solved before. The share of each pair in the sum then follows the choices back.
"""

from __future__ import annotations

from dataclasses import dataclass
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
    R, K, C = gain.shape
    best, taken = _best(gain.reshape(R * K, C), R, K)
    weight = np.exp(np.concatenate(best))
    weight /= weight.sum(axis=0)
    weights = np.split(weight, np.cumsum([len(layer) for layer in best[:-1]]))
    return _follow(weights, taken, gain.shape)


def _follow(weights: list[Floats], taken: list[Ints], shape: tuple[int, ...]) -> Floats:
    """Return the share (R, K, C) of each pair: what sets weigh goes back along their steps."""
    R, K, C = shape
    pairs, flows, cluster = [], [weights[R]], np.arange(C)
    for size in range(R, 0, -1):
        step, flow = _steps(R, K, size), flows[-1]
        chosen = (taken[size - 1], np.arange(len(flow))[:, None])
        pairs.append(step.pair[chosen] * C + cluster)
        rest, smaller = step.rest[chosen] * C + cluster, weights[size - 1]
        left = np.bincount(rest.ravel(), flow.ravel(), smaller.size)
        flows.append(left.reshape(smaller.shape) + smaller)
    pair, flow = np.concatenate(pairs), np.concatenate(flows[:-1])
    share = np.bincount(pair.ravel(), flow.ravel(), R * K * C)
    return np.asarray(share.reshape(shape), np.float64)


def _best(gain: Floats, rows: int, columns: int) -> tuple[list[Floats], list[Ints]]:
    """
    Return the log weight of the best permutation of each set, by size, and which step is its last.

    The weights (N, C) are less that of the best set of all.
    """
    best, taken = [np.zeros((1, gain.shape[1]))], []
    for size in range(1, rows + 1):
        step = _steps(rows, columns, size)
        value = best[-1].take(step.rest, axis=0)
        value += gain.take(step.pair, axis=0)
        taken.append(value.argmax(axis=0))
        best.append(value.max(axis=0))
    top = np.max([layer.max(axis=0) for layer in best], axis=0)
    return [layer - top for layer in best], taken


@dataclass(frozen=True)
class _Steps:
    """The ways to make N sets of so many rows and as many columns: the last row takes a column."""

    rest: Ints  # (size, N) position of the set that is left
    pair: Ints  # (size, N) row times K plus the column taken


@lru_cache(maxsize=128)
def _steps(rows: int, columns: int, size: int) -> _Steps:
    of_rows, fewer_rows = _subsets(rows, size)
    of_columns, fewer_columns = _subsets(columns, size)
    rest = fewer_rows[:, -1, None] * comb(columns, size - 1) + fewer_columns.T[:, None]
    pair = of_rows[:, -1, None] * columns + of_columns.T[:, None]
    return _Steps(rest.reshape(size, -1), pair.reshape(size, -1))


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
