# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What are the exact marginals of a cluster? Tables are set up here and summed in ``tables.py``.

The smaller side of a cluster, tracks or plots, is its *rows* (R), the other its *columns* (K).
C clusters of equal R are computed at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tracking_core.association.clusters import Contest
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
    layout = _lay_out(contest)
    clusters = len(layout.rows)
    probability, log_sum = np.empty(len(contest.track)), np.empty(clusters)
    safe = np.ones(clusters, np.bool_)
    for batch in _batches(layout, safe):
        safe[batch] = _solve(layout, batch, LINEAR, probability, log_sum)
    if not safe.all():
        for batch in _batches(layout, ~safe):
            _solve(layout, batch, LOGARITHMIC, probability, log_sum)
        probability = _bound(_bound(probability, contest.track), contest.plot)
    return probability, log_sum + layout.log_scale


def _bound(probability: Floats, group: Ints) -> Floats:
    """
    Divide by the sum of each group (P,) where rounding has carried it above 1.

    Logarithms of some thousands are good to 1e-12, and so is the exponential of a difference of
    two. The miss is what a sum leaves of 1: it makes up for less than 1, but not for more.
    """
    total = np.bincount(group, probability)
    return np.asarray(probability / np.maximum(total, 1.0)[group])


@dataclass(frozen=True)
class _Layout:
    """Where each pair stands in the tables of its cluster."""

    rows: Ints  # (clusters,)
    columns: Ints  # (clusters,)
    cluster: Ints  # (P,)
    row: Ints  # (P,)
    column: Ints  # (P,)
    upright: Bools  # (P,) rows are tracks, not plots
    log_weight: Floats  # (P,) scaled so that it and `log_free` are at most 0
    log_free: Floats  # (P,) of the track in no pair
    log_scale: Floats  # (clusters,) that was taken out of the sum of all events


def _lay_out(contest: Contest) -> _Layout:
    track_cluster, plot_cluster = contest.track_cluster(), contest.plot_cluster()
    tracks, plots = np.bincount(track_cluster), np.bincount(plot_cluster)
    track_rank = _rank(track_cluster, tracks)[contest.track]
    plot_rank = _rank(plot_cluster, plots)[contest.plot]
    upright = (tracks <= plots)[contest.cluster]
    top = np.zeros(contest.tracks)
    np.maximum.at(top, contest.track, contest.gain)
    return _Layout(
        rows=np.minimum(tracks, plots),
        columns=np.maximum(tracks, plots),
        cluster=contest.cluster,
        row=np.where(upright, track_rank, plot_rank),
        column=np.where(upright, plot_rank, track_rank),
        upright=upright,
        log_weight=contest.gain - top[contest.track],
        log_free=-top[contest.track],
        log_scale=np.asarray(np.bincount(track_cluster, top, len(tracks)), np.float64),
    )


def _rank(label: Ints, counts: Ints) -> Ints:
    """Return the position of each element among those with the same label."""
    order = np.argsort(label, kind='stable')
    rank = np.empty(len(label), np.int64)
    rank[order] = np.arange(len(label)) - np.repeat(np.cumsum(counts) - counts, counts)
    return rank


def _batches(layout: _Layout, wanted: Bools) -> Iterator[Ints]:
    """Yield clusters of alike rows and columns, few enough to fit into memory."""
    batch = np.flatnonzero(wanted)
    rows, columns = int(layout.rows[batch].max()), int(layout.columns[batch].max())
    if rows * columns * len(batch) << rows <= PADDING:
        yield from _split(batch, rows, columns)
        return
    batch, rows, columns = batch[:0], 0, 0
    kind = np.where(wanted, 64 * layout.rows + np.frexp(layout.columns)[1], -1)
    for alike in sorted(set(kind[wanted].tolist()), reverse=True):
        more = np.flatnonzero(kind == alike)
        if rows * columns * len(more) << rows > PADDING:
            yield from _split(batch, rows, columns)
            batch, rows, columns = batch[:0], 0, 0
        batch = np.append(batch, more)
        rows = max(rows, int(layout.rows[more[0]]))
        columns = max(columns, int(layout.columns[more].max()))
    if len(batch):
        yield from _split(batch, rows, columns)


def _split(batch: Ints, rows: int, columns: int) -> list[Ints]:
    size = max(1, MEMORY // ((2 * columns) << rows))
    return np.split(batch, range(size, len(batch), size))


def _solve(
    layout: _Layout, batch: Ints, arithmetic: Arithmetic, probability: Floats, log_sum: Floats
) -> Bools:
    """Write probabilities and sums of the batch; return which of its clusters had a safe sum."""
    place = np.full(len(layout.rows), -1)
    place[batch] = np.arange(len(batch))
    pairs = np.flatnonzero(place[layout.cluster] >= 0)
    row, column, cluster = layout.row[pairs], layout.column[pairs], place[layout.cluster[pairs]]
    rows, columns, size = layout.rows[batch].max(), layout.columns[batch].max(), len(batch)
    weight = np.full((rows, columns, size), arithmetic.zero)
    weight[row, column, cluster] = arithmetic.of_log(layout.log_weight[pairs])
    free = arithmetic.of_log(layout.log_free[pairs])
    free_row, free_column = (
        np.full_like(weight[:, 0], arithmetic.one),
        np.full_like(weight[0], arithmetic.one),
    )
    free_row[row, cluster] = np.where(layout.upright[pairs], free, arithmetic.one)
    free_column[column, cluster] = np.where(layout.upright[pairs], arithmetic.one, free)
    having, total = sum_events(weight, free_row, free_column, arithmetic)
    probability[pairs] = arithmetic.share(having[row, column, cluster], total[cluster])
    log_sum[batch] = arithmetic.to_log(total)
    return np.asarray(total > SAFE_SUM)
