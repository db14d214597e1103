# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plot is nearest? Each track takes one plot for certain, the best pairs choosing first."""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Association, Bools, Floats, Ints


def nearest(
    track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int
) -> Association:
    """
    Give each track its nearest plot, a contested plot to the track that it is worth more to.

    That is by `log_weight` - `log_miss`. The loser takes its next best plot that is free, if it
    has one. The gate alone decides whether a plot is near enough, be it no better than a miss.
    See `Associator` for the arguments.

    References
    ----------
    [BLACKMAN86], the suboptimal nearest neighbour: the best remaining pair, again and again.

    """
    tracks, chosen = len(log_miss), np.zeros(len(track), np.bool_)
    rank = np.empty(len(track), np.int64)  # unique, so that of equal weights one wins
    rank[np.argsort(log_weight - log_miss[track], kind='stable')] = np.arange(len(track))
    left = np.flatnonzero(log_weight > -np.inf)
    while len(left):
        wins = _is_best(rank[left], track[left], tracks) & _is_best(rank[left], plot[left], plots)
        won = left[wins]
        chosen[won] = True
        left = left[_is_free(track[won], tracks)[track[left]]]
        left = left[_is_free(plot[won], plots)[plot[left]]]
    return certain(chosen, track, tracks)


def _is_best(rank: Ints, group: Ints, groups: int) -> Bools:
    best = np.full(groups, -1)
    np.maximum.at(best, group, rank)
    return np.asarray(rank == best[group])


def _is_free(taken: Ints, size: int) -> Bools:
    free = np.ones(size, np.bool_)
    free[taken] = False
    return free


def certain(chosen: Bools, track: Ints, tracks: int) -> Association:
    """Return the association in which the chosen pairs (P,) are right."""
    miss = np.ones(tracks)
    miss[track[chosen]] = 0.0
    return Association(chosen.astype(np.float64), miss, np.zeros(tracks, np.bool_))
