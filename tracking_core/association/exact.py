# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What are the exact marginals of a cluster? Tables are set up here and summed in ``tables.py``.

C clusters of like size are computed at once.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.association.layout import batches, lay_out, Layout, split
from tracking_core.association.tables import (
    Arithmetic,
    LINEAR,
    LOGARITHMIC,
    SAFE_SUM,
    sum_events,
)
from tracking_core.batches import Bools, Floats, Ints

MEMORY = 2**22  # entries of all tables kept at once: 32 MB, and as much again while summing
PADDING = 50_000  # additions that cost less than a batch of their own


def marginalise(contest: Contest) -> Floats:
    """Return the exact probability of each pair, (P,)."""
    return marginalise_and_sum(contest)[0]


def marginalise_and_sum(contest: Contest) -> tuple[Floats, Floats]:
    """
    Return the exact probability of each pair (P,), and of each cluster the log sum of its events.

    The event that nobody is in a pair has weight 1.

    References
    ----------
    The sums over joint events of [FORTMANN83], by dynamic programming over sets [HELD62].

    """
    layout, top = lay_out(contest), np.zeros(contest.tracks)
    np.maximum.at(top, contest.track, contest.gain)
    # Scaled so that both are at most 0: of the pair, and of the track in no pair.
    weights = (contest.gain - top[contest.track], -top[contest.track])
    probability, log_sum = np.empty(len(contest.track)), np.empty(len(layout.rows))
    safe = np.ones(len(layout.rows), np.bool_)
    for batch in _batches(layout, safe):
        safe[batch] = _solve(layout, batch, weights, LINEAR, probability, log_sum)
    if not safe.all():
        for batch in _batches(layout, ~safe):
            _solve(layout, batch, weights, LOGARITHMIC, probability, log_sum)
        probability = _bound(_bound(probability, contest.track), contest.plot)
    return probability, log_sum + np.bincount(contest.track_cluster, top, len(log_sum))


def _bound(probability: Floats, group: Ints) -> Floats:
    """
    Divide by the sum of each group (P,) where rounding has carried it above 1.

    Logarithms of some thousands are good to 1e-12, and so is the exponential of a difference of
    two. The miss is what a sum leaves of 1: it makes up for less than 1, but not for more.
    """
    total = np.bincount(group, probability)
    return np.asarray(probability / np.maximum(total, 1.0)[group])


def _batches(layout: Layout, wanted: Bools) -> Iterator[Ints]:
    """Yield clusters of alike size, few enough to fit into memory."""
    for batch in batches(layout, wanted, _additions, PADDING):
        entries = 2 * int(layout.columns[batch].max()) << int(layout.rows[batch].max())
        yield from split(batch, MEMORY // entries)


def _additions(rows: int, columns: int) -> int:
    return rows * columns << rows


def _solve(
    layout: Layout, batch: Ints, weights: tuple[Floats, Floats], arithmetic: Arithmetic,
    probability: Floats, log_sum: Floats,
) -> Bools:  # fmt: skip
    """Write probabilities and sums of the batch; return which of its clusters had a safe sum."""
    weight, pairs, where = layout.tables(batch, arithmetic.zero)
    row, column, cluster = where
    log_weight, log_free = weights
    weight[where] = arithmetic.of_log(log_weight[pairs])
    free, upright = arithmetic.of_log(log_free[pairs]), layout.upright[pairs]
    free_row = np.full_like(weight[:, 0], arithmetic.one)
    free_column = np.full_like(weight[0], arithmetic.one)
    free_row[row, cluster] = np.where(upright, free, arithmetic.one)
    free_column[column, cluster] = np.where(upright, arithmetic.one, free)
    having, total = sum_events(weight, free_row, free_column, arithmetic)
    probability[pairs] = arithmetic.share(having[where], total[cluster])
    log_sum[batch] = arithmetic.to_log(total)
    return np.asarray(total > SAFE_SUM)
