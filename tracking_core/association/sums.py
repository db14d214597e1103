# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do the events of one track, or of one plot, add up? Sums over groups of pairs.

Each sum has a 1 in it for the event that none of the pairs is right: weights are relative to
that event.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints
from tracking_core.linalg import first_rows

LOG_2 = np.log(2.0)
NEVER = -1e9  # log weight of what cannot be; times 0 it is 0


def choose(track: Ints, gain: Floats, tracks: int) -> tuple[Floats, Floats, Floats]:
    """
    Normalise exp(`gain`) of each track's pairs together with 1 for the miss.

    Parameters
    ----------
    track : (P,) array of int
        Ascending.
    gain : (P,) array
        Any size: the greatest of each track is taken out before the exponential.
    tracks : int
        Number of tracks T.

    Returns
    -------
    tuple of (P,) array, (T,) array and (T,) array
        Probability of each pair, probability of the miss, logarithm of the sum.

    """
    top = np.zeros(tracks)
    if len(track):
        starts = first_rows(track)
        top[track[starts]] = np.maximum(np.maximum.reduceat(gain, starts), 0.0)
    weight, miss = np.exp(gain - top[track]), np.exp(-top)
    total = miss + np.bincount(track, weight, tracks)
    return weight / total[track], miss / total, top + np.log(total)


def others(weight: Floats, group: Ints, groups: int) -> Floats:
    """
    Return 1 + sum of the *other* weights of the group, (P,), to full relative accuracy.

    Taking the own weight from the sum cancels only where it is more than half of the sum. That
    is one pair of a group at most, so a second sum without these pairs serves them all.
    """
    total = 1.0 + np.bincount(group, weight, groups)
    large = 2.0 * weight > total[group]
    rest = 1.0 + np.bincount(group, np.where(large, 0.0, weight), groups)
    return np.where(large, rest[group], total[group] - weight)


def log_others(gain: Floats, group: Ints, groups: int) -> tuple[Floats, Floats]:
    """Return logarithms of `others` (P,) and of the whole sum (groups,) for weights exp(gain)."""
    total = _log_sum(gain, group, groups)
    share = gain - total[group]
    large = share > -LOG_2
    rest = _log_sum(np.where(large, -np.inf, gain), group, groups)
    less = np.log1p(-np.exp(np.minimum(share, -LOG_2)))
    return np.where(large, rest[group], total[group] + less), total


def _log_sum(gain: Floats, group: Ints, groups: int) -> Floats:
    top = np.zeros(groups)
    np.maximum.at(top, group, gain)
    return top + np.log(np.exp(-top) + np.bincount(group, np.exp(gain - top[group]), groups))
