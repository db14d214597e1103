# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which track is which, when the last scans were followed once more with other plots?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from tracking_core.batches import Floats, Ints, State, Tracks
from tracking_core.rows import take
from tracking_core.space import POINTS, Space

_SAME = 9.0  # mean square difference of two states of one contact, in units of their variances


def keep_ids(before: State, after: State, first: int, space: Space = POINTS) -> State:
    """
    Give tracks the ids that they had before; new ones get ids that nobody ever had.

    Parameters
    ----------
    before : State
        What was known when the ids were told.
    after : State
        The same scans followed again, from a state in which `first` was the next id.
    first : int
        Tracks with lower ids began earlier, and are the same in both.
    space : Space
        Where the tracks are.

    Returns
    -------
    State
        `after` with other ids from `first` on; its next id is not below that of `before`.

    """
    old = np.flatnonzero(before.tracks.id >= first)
    new = np.flatnonzero(after.tracks.id >= first)
    apart = _difference(before.tracks, old, after.tracks, new, space)
    difference = np.minimum(apart, _SAME)
    one, other = linear_sum_assignment(difference)
    same = difference[one, other] < _SAME
    fresh = np.ones(len(new), bool)
    fresh[other[same]] = False
    ids = after.tracks.id.copy()
    ids[new[other[same]]] = before.tracks.id[old[one[same]]]
    ids[new[fresh]] = before.next_id + np.arange(fresh.sum())
    tracks = replace(after.tracks, id=ids)
    return replace(
        after,
        tracks=take(tracks, np.argsort(ids, kind='stable')),
        next_id=before.next_id + int(fresh.sum()),
    )


def _difference(a: Tracks, rows: Ints, b: Tracks, columns: Ints, space: Space) -> Floats:
    """Return the mean square difference (R, C) of the states, in units of their variances."""
    total, size = np.zeros((len(rows), len(columns))), 0
    for one, other in zip(a.planes, b.planes, strict=True):
        (m, P), (n, Q) = one.moments(), other.moments()
        variance = np.einsum('tnn->tn', P)[rows, None] + np.einsum('tnn->tn', Q)[None, columns]
        apart = space.shortest(m[rows, None] - n[None, columns])
        total += (apart**2 / variance).sum(axis=2)
        size += m.shape[1]
    return total / max(size, 1)
