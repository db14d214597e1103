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

    Plots in one gate only are summed up with the miss of their track first, tracks with one shared
    plot with that plot's being nobody's, and so on in turns. This leaves contests of the same form
    for those that are linked in loops: mostly few.

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
    probability, left = np.empty(len(track)), np.ones(tracks)
    probability[own], miss, log_sum = choose(track[own], gain[own], tracks)
    rows, rival = renumber(track[shared], tracks)
    columns, prize = renumber(plot[shared], plots)
    gain = gain[shared] - log_sum[rows][rival]
    taken, rough = _contend(prize, rival, gain, len(columns), len(rows), largest)
    left[rows] = _left(taken, rival, len(rows))
    probability[shared], probability[own] = taken, probability[own] * left[track[own]]
    approximate = np.zeros(tracks, np.bool_)
    if rough.any():  # and with these all that are linked with them
        label = clusters(rival, prize, len(rows), len(columns))[1]
        approximate[rows[rival]] = np.bincount(label, rough)[label] > 0
    return Association(probability, miss * left, approximate)


def _contend(
    row: Ints, column: Ints, gain: Floats, rows: int, columns: int, largest: int,
    rows_are_tracks: bool = False,
) -> tuple[Floats, Bools]:  # fmt: skip
    """
    Return the probability of each pair (P,), and which are approximate.

    Tracks and plots have the same part in a joint event, so either may be the rows. Columns with
    one pair only are summed up with their row's being in no pair, then rows with one pair only
    with their column's, and so on: what is left has loops and goes to `_settle`.
    """
    alone = ~contested(column, columns)
    if not alone.any():
        pairs = (row, column, rows, columns) if rows_are_tracks else (column, row, columns, rows)
        return _settle(*pairs, gain, largest)
    own, rest = alone.nonzero()[0], (~alone).nonzero()[0]
    own = own[row[own].argsort(kind='stable')]
    share, _, log_sum = choose(row[own], gain[own], rows)
    probability, rough = np.empty(len(row)), np.zeros(len(row), np.bool_)
    probability[rest], rough[rest] = _contend(
        column[rest], row[rest], gain[rest] - log_sum[row[rest]], columns, rows, largest,
        not rows_are_tracks,
    )  # fmt: skip
    probability[own] = share * _left(probability[rest], row[rest], rows)[row[own]]
    return probability, rough


def _left(probability: Floats, row: Ints, rows: int) -> Floats:
    """Return the probability that none of its pairs is right for each row."""
    return np.asarray(np.maximum(1.0 - np.bincount(row, probability, rows), 0.0))


def _settle(
    track: Ints, plot: Ints, tracks: int, plots: int, gain: Floats, largest: int
) -> tuple[Floats, Bools]:
    """Do what `_contend` does where every track and every plot has several pairs."""
    probability, rough = np.empty(len(track)), np.zeros(len(track), np.bool_)
    if len(track) == 0:
        return probability, rough
    order = track.argsort(kind='stable')
    contest = _contest(track[order], plot[order], gain[order], tracks, plots)
    probability[order], rough[order] = _by_kind(contest, largest)
    return probability, rough


def _contest(track: Ints, plot: Ints, gain: Floats, tracks: int, plots: int) -> Contest:
    rows, track = renumber(track, tracks)
    columns, plot = renumber(plot, plots)
    cluster = clusters(track, plot, len(rows), len(columns))[1]
    return Contest(track, plot, gain, cluster, len(rows), len(columns))


def _by_kind(contest: Contest, largest: int) -> tuple[Floats, Bools]:
    """Return the probability of each pair (P,), and which are approximate."""
    tracks, plots = np.bincount(contest.track_cluster()), np.bincount(contest.plot_cluster())
    few, many = np.minimum(tracks, plots), np.maximum(tracks, plots)
    two, other = tracks == 2, (plots == 2) & (tracks != 2)
    large = (few > largest) | (many > TABLE >> np.minimum(few, 62))
    large &= few > 2
    tables = (few > 2) & ~large
    probability, rough = np.empty(len(contest.track)), large[contest.cluster]
    kinds = ((_duel, two), (_duel_of_plots, other), (marginalise, tables), (propagate, large))
    for solve, chosen in kinds:
        pairs = chosen[contest.cluster]
        if pairs.all():
            return solve(contest), rough
        if pairs.any():
            probability[pairs] = solve(contest.take(pairs))
    return probability, rough


def _duel_of_plots(contest: Contest) -> Floats:
    """Solve clusters of two plots, whose tracks all have both: a duel with the parts swapped."""
    order = contest.plot.argsort(kind='stable')
    probability = np.empty(len(order))
    probability[order] = _duel(
        Contest(
            contest.plot[order], contest.track[order], contest.gain[order],
            contest.cluster[order], contest.plots, contest.tracks,
        )
    )  # fmt: skip
    return probability


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
