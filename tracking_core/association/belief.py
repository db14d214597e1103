# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if a cluster is too large for exact marginals? Loopy belief propagation.

Messages between tracks and plots are repeated until the marginals stand still. They always
converge, and are right on clusters without loops; tight formations may come out wrong by 0.2.
"""

from __future__ import annotations

import numpy as np

from tracking_core.association.clusters import Contest
from tracking_core.association.sums import choose, log_others, others
from tracking_core.batches import Floats

ROUNDS = 200
TOLERANCE = 1e-6  # change of a marginal in one round
LARGEST_GAIN = 300.0  # products of two messages stay below 1e308 up to here


def propagate(contest: Contest) -> Floats:
    """
    Approximate the probability of each pair, (P,).

    References
    ----------
    [WILLIAMS14]: messages mu from track to plot, nu from plot to track.

    """
    if np.max(contest.gain) > LARGEST_GAIN:
        nu = _log_messages(contest)
    else:
        nu = np.log(_messages(contest))
    return choose(contest.track, contest.gain + nu, contest.tracks)[0]


def _messages(contest: Contest) -> Floats:
    # A gain below -LARGEST_GAIN cannot give a probability above exp(-LARGEST_GAIN) anyway.
    weight = np.exp(np.maximum(contest.gain, -LARGEST_GAIN))
    nu, last = np.ones(len(weight)), np.zeros(len(weight))
    for _ in range(ROUNDS):
        claim = weight * nu
        rest = others(claim, contest.track, contest.tracks)
        belief = claim / (claim + rest)
        if np.max(np.abs(belief - last)) < TOLERANCE:
            break
        nu, last = 1.0 / others(weight / rest, contest.plot, contest.plots), belief
    return nu


def _log_messages(contest: Contest) -> Floats:
    nu, last = np.zeros(len(contest.gain)), np.zeros(len(contest.gain))
    for _ in range(ROUNDS):
        claim = contest.gain + nu
        rest, total = log_others(claim, contest.track, contest.tracks)
        belief = np.exp(claim - total[contest.track])
        if np.max(np.abs(belief - last)) < TOLERANCE:
            break
        nu, last = -log_others(contest.gain - rest, contest.plot, contest.plots)[0], belief
    return nu
