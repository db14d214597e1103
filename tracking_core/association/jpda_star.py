# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are neighbours kept from being drawn together? JPDA without permutations: JPDA*.

Contacts side by side can trade plots with hardly any loss of weight. `jpda` adds up both ways,
so each track gets some of its neighbour's plot and the two meet in the middle: they coalesce.
`jpda_star` lets of all joint events with the same tracks in pairs and the same plots in pairs only
the most probable one be. Which plots are clutter and which tracks are missed stays open as before.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.association.contention import share_jointly, solve_each, swapped
from tracking_core.association.events import have_few, sum_up_events
from tracking_core.association.forest import sum_up_forest
from tracking_core.association.permutations import comparisons, sum_up_best
from tracking_core.association.sums import choose, NEVER
from tracking_core.batches import Association, Bools, Floats, Ints

LARGEST = 30_000  # comparisons in a cluster: seven tracks on eight plots, four on eighteen


def jpda_star(
    track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int
) -> Association:
    """
    Weigh the plots of all tracks jointly, neighbours never trading them.

    See `Associator` for the arguments. Of equally good permutations it may take one or all.

    Returns
    -------
    Association
        ``approximate`` is True for tracks in clusters too large for this, in which pairs that
        would close a loop are left out.

    References
    ----------
    [BLOM00], JPDA*; with the existence probability of [MUSICKI04] in the weights.

    """
    return share_jointly(track, plot, log_weight, log_miss, plots, _settle)


def _settle(contest: Contest) -> tuple[Floats, Bools]:
    """Return the probability of each pair (P,), and which are approximate."""
    tracks, plots = contest.sizes
    few = have_few(tracks, plots)
    if few.all():
        return sum_up_events(contest, best_only=True), np.zeros(len(contest.track), np.bool_)
    two, other = (tracks == 2) & ~few, (plots == 2) & (tracks != 2) & ~few
    rest = ~(few | two | other)
    large = np.zeros(len(tracks), np.bool_)
    sizes = zip(tracks[rest].tolist(), plots[rest].tolist(), strict=True)
    large[rest] = [comparisons(min(size), max(size)) > LARGEST for size in sizes]
    kinds = (
        (partial(sum_up_events, best_only=True), few),
        (_duel, two),
        (swapped(_duel), other),
        (sum_up_best, rest & ~large),
        (sum_up_forest, large),
    )
    return solve_each(contest, kinds), large[contest.cluster]


def _duel(contest: Contest) -> Floats:
    """
    Solve clusters of two tracks, which share all their plots.

    Of plots a and b the first track has that one by which it leads its rival more. So it may have
    a plot while the rival has none or one of a smaller lead, and the rival the other way round.
    """
    order = np.argsort(contest.plot, kind='stable')
    one, two = order[0::2], order[1::2]  # pairs of the first track, of the second
    gain = np.maximum(contest.gain, NEVER)
    by_lead = np.lexsort((gain[one] - gain[two], contest.cluster[one]))
    one, two = one[by_lead], two[by_lead]
    cluster = contest.cluster[one]
    below = np.arange(len(one)) - np.searchsorted(cluster, cluster)  # plots of a smaller lead
    above = np.bincount(cluster)[cluster] - 1 - below
    left = np.empty(len(gain))
    left[one] = _left_to_rival(below, gain[two], cluster)
    left[two] = _left_to_rival(above, gain[one], cluster)
    return choose(contest.track, gain + left, contest.tracks)[0]


def _left_to_rival(place: Ints, gain: Floats, cluster: Ints) -> Floats:
    """Return the log share (N,) of what the rival may do, which is none or any earlier place."""
    table = np.full((place.max() + 2, cluster.max() + 1), -np.inf)
    table[0] = 0.0
    table[place + 1, cluster] = gain
    total = np.logaddexp.accumulate(table, axis=0)
    return np.asarray(total[place, cluster] - total[-1, cluster])
