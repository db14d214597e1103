# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Where does each pair stand in the table of its cluster, and which clusters are solved at once?

The smaller side of a cluster, tracks or plots, is its *rows* (R), the other its *columns* (K).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.batches import Bools, Floats, Ints

Cost = Callable[[int, int], int]  # of a cluster with so many rows and columns


@dataclass(frozen=True)
class Layout:
    """Clusters as tables."""

    rows: Ints  # (clusters,)
    columns: Ints  # (clusters,)
    cluster: Ints  # (P,)
    row: Ints  # (P,)
    column: Ints  # (P,)
    upright: Bools  # (P,) rows are tracks, not plots

    def tables(self, batch: Ints, fill: float) -> tuple[Floats, Ints, tuple[Ints, Ints, Ints]]:
        """
        Return an empty table for clusters of the batch, their pairs, and where these stand in it.

        Parameters
        ----------
        batch : (C,) array of int
            Clusters.
        fill : float
            What stands where there is no pair.

        Returns
        -------
        tuple of (R, K, C) array, (N,) array and three (N,) arrays
            R and K of the largest cluster.

        """
        place = np.full(len(self.rows), -1)
        place[batch] = np.arange(len(batch))
        cluster = place[self.cluster]
        pairs = (cluster >= 0).nonzero()[0]
        shape = (int(self.rows[batch].max()), int(self.columns[batch].max()), len(batch))
        where = (self.row[pairs], self.column[pairs], cluster[pairs])
        return np.full(shape, fill), pairs, where


def lay_out(contest: Contest) -> Layout:
    """Return the places of all pairs."""
    tracks, plots = contest.sizes
    track_rank = _rank(contest.track_cluster, tracks)[contest.track]
    plot_rank = _rank(contest.plot_cluster, plots)[contest.plot]
    upright = (tracks <= plots)[contest.cluster]
    return Layout(
        rows=np.minimum(tracks, plots),
        columns=np.maximum(tracks, plots),
        cluster=contest.cluster,
        row=np.where(upright, track_rank, plot_rank),
        column=np.where(upright, plot_rank, track_rank),
        upright=upright,
    )


def _rank(label: Ints, counts: Ints) -> Ints:
    """Return the position of each element among those with the same label."""
    order = label.argsort(kind='stable')
    rank = np.empty(len(label), np.int64)
    rank[order] = np.arange(len(label)) - (counts.cumsum() - counts).repeat(counts)
    return rank


def batches(layout: Layout, wanted: Bools, cost: Cost, padding: int) -> Iterator[Ints]:
    """
    Yield clusters of alike rows and columns.

    Parameters
    ----------
    layout : Layout
        Of all clusters.
    wanted : (clusters,) array
        Which are to be solved, one at least.
    cost : callable
        Of a cluster, from the numbers of its rows and columns.
    padding : int
        Cost that is less than that of a batch of its own: so much may be made alike by padding.

    """
    batch = wanted.nonzero()[0]
    rows, columns = int(layout.rows[batch].max()), int(layout.columns[batch].max())
    if cost(rows, columns) * len(batch) <= padding:
        yield batch
        return
    batch, rows, columns = batch[:0], 0, 0
    kind = np.where(wanted, 64 * layout.rows + np.frexp(layout.columns)[1], -1)
    for alike in sorted(set(kind[wanted].tolist()), reverse=True):
        more = np.flatnonzero(kind == alike)
        if len(batch) and cost(rows, columns) * len(more) > padding:
            yield batch
            batch, rows, columns = batch[:0], 0, 0
        batch = np.append(batch, more)
        rows = max(rows, int(layout.rows[more[0]]))
        columns = max(columns, int(layout.columns[more].max()))
    yield batch


def split(batch: Ints, size: int) -> list[Ints]:
    """Return the batch in parts of so many clusters, one at least."""
    size = max(1, size)
    if len(batch) <= size:
        return [batch]
    return np.split(batch, range(size, len(batch), size))
