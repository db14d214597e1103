# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which tracks compete for plots? Pairs that share a plot, and the clusters that they form.

A plot in one gate only cannot be taken away from its track, so clusters hang together by the
*contested* plots alone. In an ordinary scan these are few.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

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
    label = linked(track[shared], plot[shared], tracks, plots)
    return label, label[track]


def linked(track: Ints, plot: Ints, tracks: int, plots: int) -> Ints:
    """Label (T,) the groups of tracks that are linked by any plots, as `clusters` does."""
    return renumber(_first_of_linked(track, plot, tracks, plots), tracks)[1]


def _first_of_linked(track: Ints, plot: Ints, tracks: int, plots: int) -> Ints:
    """Return the first of all tracks that each one (T,) is linked with, over any way."""
    first = np.arange(tracks)
    while True:
        here, at_plot, better = first[track], np.full(plots, tracks), np.arange(tracks)
        np.minimum.at(at_plot, plot, here)
        if np.array_equal(here, at_plot[plot]):
            return first
        np.minimum.at(better, here, at_plot[plot])  # whole groups move to the first of another
        while not np.array_equal(first, better[first]):
            first = better[first]


def contested(plot: Ints, plots: int) -> Bools:
    """Return (P,) True where the plot of the pair lies in more than one gate."""
    return np.asarray(np.bincount(plot, minlength=plots) > 1)[plot]


def renumber(values: Ints, size: int) -> tuple[Ints, Ints]:
    """Return the values that occur, ascending, and `values` as positions in those."""
    occurs = np.zeros(size, np.bool_)
    occurs[values] = True
    return occurs.nonzero()[0], (occurs.cumsum() - 1)[values]


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

    def swap(self) -> tuple[Ints, Contest]:
        """Return the contest with the parts of tracks and plots swapped, and its pairs in ours."""
        order = self.plot.argsort(kind='stable')
        swapped = Contest(
            self.plot[order], self.track[order], self.gain[order], self.cluster[order],
            self.plots, self.tracks,
        )  # fmt: skip
        return order, swapped

    @cached_property
    def track_cluster(self) -> Ints:
        """Cluster of each track."""
        return _spread(self.cluster, self.track, self.tracks)

    @cached_property
    def plot_cluster(self) -> Ints:
        """Cluster of each plot."""
        return _spread(self.cluster, self.plot, self.plots)

    @cached_property
    def sizes(self) -> tuple[Ints, Ints]:
        """Number of tracks and number of plots of each cluster."""
        return np.bincount(self.track_cluster), np.bincount(self.plot_cluster)


def _spread(values: Ints, places: Ints, size: int) -> Ints:
    result = np.empty(size, np.int64)
    result[places] = values
    return result
