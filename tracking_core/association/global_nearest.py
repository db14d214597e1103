# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which joint event is the most probable? One assignment for all tracks at once."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import min_weight_full_bipartite_matching

from tracking_core.association.clusters import clusters, contested, renumber
from tracking_core.association.nearest import certain
from tracking_core.batches import Association, Bools, Floats, Ints

PART = 200  # tracks matched in one call: the solver takes more than twice the time for twice


def global_nearest(
    track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int
) -> Association:
    """
    Take the joint event with the greatest sum of `log_weight` - `log_miss` for certain.

    This is the mode of the distribution whose marginals `jpda` gives, if all tracks exist. A pair
    no better than the miss of its track is never taken, even if no other track wants the plot: at
    the edge of a gate in dense clutter the plot is more probably clutter. `nearest` would take it.
    See `Associator` for the arguments.

    References
    ----------
    [BLACKMAN99], global nearest neighbour, here as a sparse assignment problem.

    """
    tracks, gain = len(log_miss), log_weight - log_miss[track]
    worth = np.flatnonzero(gain > 0.0)
    row, column, gain = track[worth], plot[worth], gain[worth]
    shared = contested(column, plots)
    # Of the plots that nobody else wants, only the best matters: it stands in for the miss.
    fallback = np.zeros(tracks)
    np.maximum.at(fallback, row[~shared], gain[~shared])
    taken = _match(row[shared], column[shared], gain[shared], fallback, plots)
    loses = np.ones(tracks, np.bool_)
    loses[row[shared][taken]] = False
    best = np.flatnonzero(~shared & (gain == fallback[row]) & loses[row])
    best = best[np.diff(row[best], prepend=-1) > 0]  # one of equals
    chosen = np.zeros(len(track), np.bool_)
    chosen[worth[shared][taken]] = True
    chosen[worth[best]] = True
    return certain(chosen, track, tracks)


def _match(row: Ints, column: Ints, gain: Floats, fallback: Floats, plots: int) -> Bools:
    """Return which pairs (P,) the best matching takes; each track may have its own fallback."""
    rows, row = renumber(row, len(fallback))
    columns, column = renumber(column, plots)
    taken = np.zeros(len(row), np.bool_)
    for part in _parts(row, column, len(rows), len(columns)):
        some, ends = renumber(row[part], len(rows))
        taken[part] = _match_part(ends, column[part], gain[part], fallback[rows[some]])
    return taken


def _parts(row: Ints, column: Ints, rows: int, columns: int) -> list[Ints]:
    """Split pairs (P,) into whole clusters of some `PART` tracks together."""
    if rows <= PART:
        return [np.arange(len(row))] if rows else []
    label, pair_label = clusters(row, column, rows, columns)
    part = (np.cumsum(np.bincount(label)) // PART)[pair_label]
    order = np.argsort(part, kind='stable')
    return np.split(order, np.flatnonzero(np.diff(part[order])) + 1)


def _match_part(row: Ints, column: Ints, gain: Floats, fallback: Floats) -> Bools:
    columns, column = renumber(column, int(column.max()) + 1)
    dummy = np.arange(len(fallback))
    gains = np.concatenate([gain, fallback])
    # A full matching has one entry of each row, so a common offset does not matter; it keeps
    # entries positive, since the sparse solver takes no zeros.
    cost = 1.0 + np.max(gains) - gains
    ends = (np.concatenate([row, dummy]), np.concatenate([column, len(columns) + dummy]))
    places = tuple(end.astype(np.int32) for end in ends)  # the only type scipy 1.11 takes
    table = csr_array((cost, places), shape=(len(dummy), len(columns) + len(dummy)))
    match = min_weight_full_bipartite_matching(table)[1]
    return np.asarray(match[row] == column)
