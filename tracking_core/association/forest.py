# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if there are too many permutations? A forest has none.

Tracks and plots are the nodes, pairs the edges, and whoever trades plots goes round a loop. Of
all pairs those stay that make the greatest forest: the best assignment, then whatever is the most
probable without closing a loop. Its marginals are exact, at any size.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import minimum_spanning_tree

from tracking_core.association.clusters import Contest
from tracking_core.association.global_nearest import global_nearest
from tracking_core.association.jpda import jpda
from tracking_core.association.sums import NEVER
from tracking_core.batches import Bools, Floats


def sum_up_forest(contest: Contest) -> Floats:
    """Return the probability of each pair (P,), 0 for those that do not stay."""
    probability, stays = np.zeros(len(contest.track)), _forest(contest)
    track, plot, gain = contest.track[stays], contest.plot[stays], contest.gain[stays]
    solved = jpda(track, plot, gain, np.zeros(contest.tracks), contest.plots)
    probability[stays] = solved.probability
    return probability


def _forest(contest: Contest) -> Bools:
    """Return which pairs (P,) stay."""
    track, plot, gain = contest.track, contest.plot, np.maximum(contest.gain, NEVER)
    nothing = np.zeros(contest.tracks)
    best = global_nearest(track, plot, gain, nothing, contest.plots).probability > 0.5
    of_track, of_plot = nothing, np.zeros(contest.plots)
    of_track[track[best]], of_plot[plot[best]] = gain[best], gain[best]
    # How much the best event loses if the pair is put in the place of what these two have: >= 0.
    loss = of_track[track] + of_plot[plot] - gain
    cost = np.where(best, 0.5, 1.0 + np.maximum(loss, 0.0))
    nodes = contest.tracks + contest.plots
    ends = (track.astype(np.int32), (contest.tracks + plot).astype(np.int32))
    tree = minimum_spanning_tree(csr_array((cost, ends), shape=(nodes, nodes))).tocoo()
    return np.isin(track * nodes + ends[1], tree.row * np.int64(nodes) + tree.col)
