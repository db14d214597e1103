# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are plots weighed for tracks that compete? Joint probabilistic data association.

Marginals over all joint events, cluster by cluster: in closed form for one track and for two,
exactly for clusters up to a size, by belief propagation beyond. All clusters of a kind are
computed at once.
"""

from __future__ import annotations

import numpy as np

from tracking_core.association.belief import propagate
from tracking_core.association.clusters import clusters, Contest, contested, renumber
from tracking_core.association.exact import marginalise
from tracking_core.association.pda import pda
from tracking_core.association.sums import choose, log_others
from tracking_core.batches import Association, Bools, Floats, Ints

LARGEST = 10  # tracks, or contested plots if fewer, of a cluster that gets exact marginals
TABLE = 2**20  # entries of the largest table for one cluster: bounds time and memory


def jpda(
    track: Ints,
    plot: Ints,
    log_weight: Floats,
    log_miss: Floats,
    plots: int,
    *,
    largest: int = LARGEST,
) -> Association:
    """
    Weigh the plots of all tracks jointly: no plot comes from two tracks.

    Plots in one gate only are summed up with the miss of their track first, which leaves a
    contest for the shared plots with the same form and, mostly, few tracks.

    Parameters
    ----------
    track, plot, log_weight, log_miss, plots
        See `Associator`.
    largest : int
        Clusters with more tracks and more contested plots than this are approximated.

    Returns
    -------
    Association
        ``approximate`` is True for tracks whose marginals are from belief propagation.

    References
    ----------
    [FORTMANN83], with the existence probability of [MUSICKI04] in the weights.

    """
    shared = contested(plot, plots)
    if not shared.any():
        return pda(track, plot, log_weight, log_miss, plots)
    tracks, gain = len(log_miss), log_weight - log_miss[track]
    own = ~shared
    probability = np.empty(len(track))
    probability[own], miss, log_sum = choose(track[own], gain[own], tracks)
    contest, rows = _contest(track[shared], plot[shared], gain[shared], log_sum, plots)
    probability[shared], rough = _settle(contest, largest)
    left, approximate = np.ones(tracks), np.zeros(tracks, np.bool_)
    taken = np.bincount(contest.track, probability[shared])
    left[rows], approximate[rows] = np.maximum(1.0 - taken, 0.0), rough
    probability[own] *= left[track[own]]
    return Association(probability, miss * left, approximate)


def _contest(
    track: Ints, plot: Ints, gain: Floats, log_sum: Floats, plots: int
) -> tuple[Contest, Ints]:
    """Return the contest for the shared plots and the tracks that are in it."""
    gain = gain - log_sum[track]
    rows, track = renumber(track, len(log_sum))
    columns, plot = renumber(plot, plots)
    cluster = clusters(track, plot, len(rows), len(columns))[1]
    return Contest(track, plot, gain, cluster, len(rows), len(columns)), rows


def _settle(contest: Contest, largest: int) -> tuple[Floats, Bools]:
    """Return probability of the pairs (P,), and for which tracks (T,) it is approximate."""
    track_cluster = contest.track_cluster()
    tracks, plots = np.bincount(track_cluster), np.bincount(contest.plot_cluster())
    few, many = np.minimum(tracks, plots), np.maximum(tracks, plots)
    two = tracks == 2
    large = ~two & ((few > largest) | (many > TABLE >> np.minimum(few, 62)))
    probability = np.empty(len(contest.track))
    for solve, chosen in ((_duel, two), (marginalise, ~two & ~large), (propagate, large)):
        pairs = chosen[contest.cluster]
        if pairs.all():
            return solve(contest), large[track_cluster]
        if pairs.any():
            probability[pairs] = solve(contest.take(pairs))
    return probability, large[track_cluster]


def _duel(contest: Contest) -> Floats:
    """
    Solve clusters of two tracks, which share all their plots.

    A track has plot i with the weight of the pair times what its rival may then do: miss or take
    any other plot.
    """
    rest, total = log_others(contest.gain, contest.track, contest.tracks)
    order = np.argsort(contest.plot, kind='stable')
    rival = np.empty(len(order), np.int64)
    rival[order[0::2]], rival[order[1::2]] = order[1::2], order[0::2]
    left = rest[rival] - total[contest.track[rival]]
    return choose(contest.track, contest.gain + left, contest.tracks)[0]
