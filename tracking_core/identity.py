# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which track is which, when the last scans were followed once more with other plots?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from tracking_core.batches import Floats, Ints, Tracks
from tracking_core.rows import take
from tracking_core.space import POINTS, Space
from tracking_core.state import State

_SAME = 9.0  # mean square difference of two states of one contact, in units of their variances


def keep_ids(before: State, after: State, first: int, space: Space = POINTS) -> State:
    """
    Give tracks the ids that they had before; new ones get ids that nobody ever had.

    Tracks whose id is in both states are the same. The others are compared.

    Parameters
    ----------
    before : State
        What was known when the ids were told.
    after : State
        The same scans followed again, from a state whose next id nobody ever had.
    first : int
        Lowest id of the last scan of `after`: new ones are counted from it, without gaps.
    space : Space
        Where the tracks are.

    Returns
    -------
    State
        `after` with the ids of `before`.

    """
    ids = after.tracks.id.copy()
    old = np.flatnonzero(~np.isin(before.tracks.id, ids))
    new = np.flatnonzero(~np.isin(ids, before.tracks.id))
    apart = _difference(before.tracks, old, after.tracks, new, space)
    difference = np.minimum(apart, _SAME)
    one, other = linear_sum_assignment(difference)
    same = difference[one, other] < _SAME
    ids[new[other[same]]] = before.tracks.id[old[one[same]]]
    fresh = ids >= first
    ids[fresh] = first + np.arange(fresh.sum())
    tracks = replace(after.tracks, id=ids)
    return replace(
        after,
        tracks=take(tracks, np.argsort(ids, kind='stable')),
        next_id=first + int(fresh.sum()),
    )


def _difference(a: Tracks, rows: Ints, b: Tracks, columns: Ints, space: Space) -> Floats:
    """
    Return the mean square difference (R, C) of the states, in units of their variances.

    It is infinite between states of other dimensions: the radar was found to tell heights.
    """
    total, size = np.zeros((len(rows), len(columns))), 0
    if [p.mean.shape[2] for p in a.planes] != [p.mean.shape[2] for p in b.planes]:
        return total + np.inf
    for one, other in zip(a.planes, b.planes, strict=True):
        (m, P), (n, Q) = one.moments(), other.moments()
        variance = np.einsum('tnn->tn', P)[rows, None] + np.einsum('tnn->tn', Q)[None, columns]
        apart = space.shortest(m[rows, None] - n[None, columns])
        total += (apart**2 / variance).sum(axis=2)
        size += m.shape[1]
    return total / max(size, 1)
