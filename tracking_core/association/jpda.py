# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are plots weighed for tracks that compete? Joint probabilistic data association.

Marginals over all joint events, cluster by cluster: in closed form for one track and for two,
exactly for clusters up to a size, by belief propagation beyond. All clusters of a kind are
computed at once. Read ``contention.py`` first: what is summed up before.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from tracking_core.association.belief import propagate
from tracking_core.association.clusters import Contest
from tracking_core.association.contention import share_jointly, solve_each, swapped
from tracking_core.association.events import have_few, sum_up_events
from tracking_core.association.exact import marginalise
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
    settle = partial(sum_up, largest=largest)
    return share_jointly(track, plot, log_weight, log_miss, plots, settle)


def sum_up(contest: Contest, largest: int = LARGEST) -> tuple[Floats, Bools]:
    """Return the probability of each pair (P,), and which are approximate."""
    tracks, plots = contest.sizes
    rows, columns = np.minimum(tracks, plots), np.maximum(tracks, plots)
    few = have_few(tracks, plots) & (rows <= largest)
    if few.all():
        return sum_up_events(contest), np.zeros(len(contest.track), np.bool_)
    two, other = (tracks == 2) & ~few, (plots == 2) & (tracks != 2) & ~few
    large = (rows > largest) | (columns > TABLE >> np.minimum(rows, 62))
    large &= rows > 2
    tables = ~(few | two | other | large)
    kinds = (
        (sum_up_events, few),
        (_duel, two),
        (swapped(_duel), other),
        (marginalise, tables),
        (propagate, large),
    )
    return solve_each(contest, kinds), large[contest.cluster]


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
