# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What can be summed up before any table is set up? All that hangs on by one pair.

What is left are contests in which every track and every plot has several pairs; how these are
settled is what `jpda` and `jpda_star` differ in.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from tracking_core.association.clusters import clusters, Contest, contested, linked, renumber
from tracking_core.association.pda import pda
from tracking_core.association.sums import choose
from tracking_core.batches import Association, Bools, Floats, Ints

# Returns the probability of each pair (P,), and which are approximate.
Settle = Callable[[Contest], tuple[Floats, Bools]]
Solve = Callable[[Contest], Floats]  # without the latter


def share_jointly(
    track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int, settle: Settle
) -> Association:
    """
    Weigh the plots of all tracks jointly: no plot comes from two tracks.

    Plots in one gate only are summed up with the miss of their track first, tracks with one shared
    plot with that plot's being nobody's, and so on in turns. This leaves contests of the same form
    for those that are linked in loops: mostly few. It is exact for `jpda_star`, too: of two events
    with the same tracks and the same plots in pairs either both have a pair that is in no loop, or
    neither.

    Parameters
    ----------
    track, plot, log_weight, log_miss, plots
        See `Associator`.
    settle : callable
        Solves what is left.

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
    taken, rough = _contend(prize, rival, gain, len(columns), len(rows), settle)
    left[rows] = _left(taken, rival, len(rows))
    probability[shared], probability[own] = taken, probability[own] * left[track[own]]
    approximate = np.zeros(tracks, np.bool_)
    if rough.any():  # and with these all that are linked with them
        label = clusters(rival, prize, len(rows), len(columns))[1]
        approximate[rows[rival]] = np.bincount(label, rough)[label] > 0
    return Association(probability, miss * left, approximate)


def solve_each(contest: Contest, kinds: Iterable[tuple[Solve, Bools]]) -> Floats:
    """Return the probability of each pair (P,), each cluster solved as that one kind it is of."""
    probability = np.empty(len(contest.track))
    for solve, chosen in kinds:
        pairs = chosen[contest.cluster]
        if pairs.all():
            return solve(contest)
        if pairs.any():
            probability[pairs] = solve(contest.take(pairs))
    return probability


def swapped(solve: Solve) -> Solve:
    """Return what solves clusters of two plots, if `solve` does so with those of two tracks."""

    def solve_swapped(contest: Contest) -> Floats:
        order, turned = contest.swap()
        probability = np.empty(len(order))
        probability[order] = solve(turned)
        return probability

    return solve_swapped


def _contend(
    row: Ints, column: Ints, gain: Floats, rows: int, columns: int, settle: Settle,
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
        return _settle(*pairs, gain, settle)
    own, rest = alone.nonzero()[0], (~alone).nonzero()[0]
    own = own[row[own].argsort(kind='stable')]
    share, _, log_sum = choose(row[own], gain[own], rows)
    probability, rough = np.empty(len(row)), np.zeros(len(row), np.bool_)
    probability[rest], rough[rest] = _contend(
        column[rest], row[rest], gain[rest] - log_sum[row[rest]], columns, rows, settle,
        not rows_are_tracks,
    )  # fmt: skip
    probability[own] = share * _left(probability[rest], row[rest], rows)[row[own]]
    return probability, rough


def _left(probability: Floats, row: Ints, rows: int) -> Floats:
    """Return the probability that none of its pairs is right for each row."""
    return np.asarray(np.maximum(1.0 - np.bincount(row, probability, rows), 0.0))


def _settle(
    track: Ints, plot: Ints, tracks: int, plots: int, gain: Floats, settle: Settle
) -> tuple[Floats, Bools]:
    """Do what `_contend` does where every track and every plot has several pairs."""
    probability, rough = np.empty(len(track)), np.zeros(len(track), np.bool_)
    if len(track) == 0:
        return probability, rough
    order = track.argsort(kind='stable')
    contest = _contest(track[order], plot[order], gain[order], tracks, plots)
    probability[order], rough[order] = settle(contest)
    return probability, rough


def _contest(track: Ints, plot: Ints, gain: Floats, tracks: int, plots: int) -> Contest:
    rows, track = renumber(track, tracks)
    columns, plot = renumber(plot, plots)
    cluster = linked(track, plot, len(rows), len(columns))[track]
    return Contest(track, plot, gain, cluster, len(rows), len(columns))
