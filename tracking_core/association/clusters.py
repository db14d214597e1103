# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which tracks compete for plots? Pairs that share a plot, and the clusters that they form.

A plot in one gate only cannot be taken away from its track, so clusters hang together by the
*contested* plots alone. In an ordinary scan these are few.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from tracking_core.batches import Bools, Floats, Ints


def clusters(track: Ints, plot: Ints, tracks: int, plots: int) -> tuple[Ints, Ints]:
    """
    Label the groups of tracks that are linked by plots in more than one gate.

    Parameters
    ----------
    track, plot : (P,) arrays of int
        Gated pairs, sorted by track.
    tracks, plots : int
        Number of tracks T and plots M.

    Returns
    -------
    tuple of (T,) array of int and (P,) array of int
        Cluster of each track and of each pair: 0, 1, ... without a gap, in the order of their
        first tracks. A track that shares no plot is a cluster of its own.

    """
    shared = contested(plot, plots)
    if not shared.any():
        return np.arange(tracks), track
    rows, columns = track[shared], plot[shared]
    ends = np.zeros(tracks + plots + 1, np.int32)
    ends[1 : tracks + 1] = np.cumsum(np.bincount(rows, minlength=tracks))
    ends[tracks + 1 :] = len(rows)
    links = (np.ones(len(rows)), (tracks + columns).astype(np.int32), ends)
    graph = csr_array(links, shape=(tracks + plots, tracks + plots))
    label = connected_components(graph, directed=False)[1][:tracks].astype(np.int64)
    return label, label[track]


def contested(plot: Ints, plots: int) -> Bools:
    """Return (P,) True where the plot of the pair lies in more than one gate."""
    return np.asarray(np.bincount(plot, minlength=plots) > 1)[plot]


def renumber(values: Ints, size: int) -> tuple[Ints, Ints]:
    """Return the values that occur, ascending, and `values` as positions in those."""
    occurs = np.zeros(size, np.bool_)
    occurs[values] = True
    return np.flatnonzero(occurs), (np.cumsum(occurs) - 1)[values]


@dataclass(frozen=True)
class Contest:
    """Pairs whose tracks compete; tracks, plots and clusters are numbered without a gap."""

    track: Ints  # (P,) ascending
    plot: Ints  # (P,)
    gain: Floats  # (P,) log weight of the pair less that of the track's being in none
    cluster: Ints  # (P,)
    tracks: int
    plots: int

    def take(self, pairs: Bools) -> Contest:
        """Return the contest of these pairs (P,) alone; they must be whole clusters."""
        rows, track = renumber(self.track[pairs], self.tracks)
        columns, plot = renumber(self.plot[pairs], self.plots)
        cluster = renumber(self.cluster[pairs], self.tracks)[1]
        return Contest(track, plot, self.gain[pairs], cluster, len(rows), len(columns))

    def track_cluster(self) -> Ints:
        """Return the cluster of each track."""
        return _spread(self.cluster, self.track, self.tracks)

    def plot_cluster(self) -> Ints:
        """Return the cluster of each plot."""
        return _spread(self.cluster, self.plot, self.plots)


def _spread(values: Ints, places: Ints, size: int) -> Ints:
    result = np.empty(size, np.int64)
    result[places] = values
    return result
