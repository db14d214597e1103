# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which plots of successive looks are of one contact, before there are tracks?

Where the noise of plots is told far too small, gates hold nothing, and no track is confirmed that
could show the noise. But where contacts are far apart and false plots are few, a plot is followed
by the only one within the reach of a contact in the next look, whatever the noise is.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from tracking_core.batches import Floats, Ints
from tracking_core.space import Space

_WIDEST = 30.0  # sds as told, that two plots of a contact may be apart
_PARTS = (1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125)  # of that: among many plots less is looked at
_CROWDED = 0.5  # plots of others within reach: then less of it is tried at once
_BY_CHANCE = 0.1  # of three plots in a row, which others than contacts may make
_IN_ROWS = 0.25  # of the plots in chains are between two: fewer are in pairs, by chance
_FEWEST = 2.5  # plots a look in chains: two contacts may turn all the time


def chains(
    time: Floats, position: Floats, variance: Floats, interval: float, speed: float, space: Space
) -> Ints:
    """
    Return the chain that each of N plots of a few looks is in, 1, 2, ...; 0: of none.

    Parameters
    ----------
    time : (N,) array
        [s]
    position, variance : (N, d) arrays
        In the tracking frame [m], and how well it is told on each axis [m^2].
    interval : float
        From one look to the next [s].
    speed : float
        Of the fastest contact [m/s].
    space : Space
        Where plots are.

    """
    N = len(time)
    looks = 1.0 + float(np.ptp(time)) / interval if N else 0.0
    farthest = interval * speed + _WIDEST * np.sqrt(2.0 * variance.max(axis=1, initial=0.0))
    reach = np.broadcast_to(farthest[:, None], position.shape)  # any axis may be told wrong
    last = (time > time.max(initial=-np.inf) - interval).nonzero()[0]
    for part in _PARTS if _FEWEST * looks < N else ():
        near = space.find_pairs(position[last], part * reach[last], position[last])[0]
        if len(near) > (1.0 + _CROWDED) * len(last):
            continue
        first, second, beside = _links(time / interval, position, part * reach, space)
        before, behind = (np.bincount(ends, minlength=N) for ends in (second, first))
        linked, between = before + behind > 0, int((before * behind).sum())
        are_rows = between >= max(_chance(beside) / _BY_CHANCE, _IN_ROWS * linked.sum())
        if not are_rows or linked.sum() <= _FEWEST * looks:
            if beside.any():
                continue
            break  # nobody is in the way: less reach would find less
        link = coo_array((np.ones(len(first)), (first, second)), shape=(N, N))
        chain = 1 + connected_components(link, directed=False)[1]
        return np.where(linked, chain, 0)
    return np.zeros(N, np.int64)


def _links(look: Floats, position: Floats, reach: Floats, space: Space) -> tuple[Ints, Ints, Ints]:
    """Return which plots (P,) only one (P,) follows, and how many (N,) there are beside each."""
    N = len(look)
    one, other = space.find_pairs(position, reach, position)
    later = look[other] - look[one]
    beside = np.bincount(one[(np.abs(later) < 0.5) & (one != other)], minlength=N)
    is_next = (later >= 0.5) & (later < 1.5)
    first, second = one[is_next], other[is_next]
    only = (np.bincount(first, minlength=N)[first] == 1) & (beside[first] == 0)
    only &= (np.bincount(second, minlength=N)[second] == 1) & (beside[second] == 0)
    return first[only], second[only], beside


def _chance(beside: Ints) -> float:
    """Return how many plots have just one before and behind by chance, if so many are beside."""
    usual = float(beside.mean())
    return len(beside) * usual**2 * math.exp(-4.0 * usual)  # none beside it and these two, either
