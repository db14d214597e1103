# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which tracks follow the same contact?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Bools, Floats, Ints, Tracks
from tracking_core.lifecycle_config import MergeConfig
from tracking_core.linalg import inverse
from tracking_core.rows import change, take_rows
from tracking_core.space import POINTS, Space

_SHARE = 1.0 / 3.0  # of its plots; a true double is one soon after its start


def end_doubles(
    tracks: Tracks,
    passed: Bools,
    config: MergeConfig,
    space: Space = POINTS,
    is_unresolved: bool = False,
    has_own_plots: bool = False,
) -> tuple[Tracks, Bools]:
    """
    Return the tracks with their looks as doubles counted, and which of them are to go.

    Contacts that cross are near each other for a look or two, doubles stay so: a confirmed track
    goes after `config.looks` looks in a row, a tentative one at once. Contacts that stay near each
    other for long have a plot each, doubles one between them: a look with two ends the row.
    Contacts that have plots in common were apart before they met: of such, a track must have been
    a double for a third of all its plots.

    Parameters
    ----------
    tracks : Tracks
        T tracks.
    passed : (T,) array
        Looked at in this scan.
    config : MergeConfig
        What counts as near, and how long.
    space : Space
        Where the tracks are.
    is_unresolved : bool
        Contacts may have plots in common.
    has_own_plots : bool
        No plot is ever that of two tracks.

    """
    near = duplicates(tracks, config.distance, space, has_own_plots)
    if not (near.any() or tracks.doubled.any()):
        return tracks, near
    looks = np.where(near, tracks.doubled + 1, 0)
    tracks = change(tracks, doubled=np.where(passed, looks, tracks.doubled))
    patience = np.maximum(config.looks, _SHARE * tracks.hits if is_unresolved else 0)
    return tracks, near & (~tracks.confirmed | (tracks.doubled >= patience))


def duplicates(
    tracks: Tracks, distance: float, space: Space = POINTS, has_own_plots: bool = False
) -> Bools:
    """
    Return which tracks (T,) are second ones on a contact that an older or surer track follows.

    Two tracks are one when their states are within `distance` (Mahalanobis, in the sum of their
    covariances) in every plane. Of angular states only angle and rate count. Confirmed tracks that
    both had a plot in their last look are two where plots are never shared (`has_own_plots`), but
    for a third one there.
    """
    T = len(tracks)
    lost = np.zeros(T, bool)
    if distance == 0.0 or T < 2:
        return lost
    moments = [space.comparable(*plane.moments()) for plane in tracks.planes]
    mean, covariance = moments[0]
    position = mean[:, 0::2]
    sd = np.sqrt(covariance.diagonal(0, 1, 2)[:, 0::2])
    # Each looks as far as the pair may be apart if it is the vaguer one of the two.
    reach = np.sqrt(2.0 * mean.shape[1]) * distance * sd
    one, other = space.find_pairs(position, reach, position)
    apart = one != other
    first, second = np.minimum(one, other)[apart], np.maximum(one, other)[apart]
    for part in (slice(0, None, 2), slice(None)):  # places are no farther apart than states
        for m, P in moments:
            if len(first) == 0:
                return lost
            dt = tracks.time[second] - tracks.time[first]
            distances = _distance_squared(m, P, first, second, dt, space, part)
            near = distances <= distance**2 * m.shape[1]
            first, second = first[near], second[near]
    if has_own_plots and len(first):
        alone = _share_their_plots(tracks, first, second)
        first, second = first[alone], second[alone]
    rank = _rank(tracks)
    lost[np.where(rank[first] < rank[second], second, first)] = True
    return lost


def _share_their_plots(tracks: Tracks, first: Ints, second: Ints) -> Bools:
    """
    Return which pairs (P,) of near tracks have not a plot each.

    Of more than two confirmed tracks in one place plots say nothing: a jammer gives each its own.
    """
    sure = tracks.confirmed[first] & tracks.confirmed[second]
    if not sure.any():
        return ~sure
    T = len(tracks)
    pair = np.unique(first[sure] * T + second[sure])  # some come twice
    others = np.bincount(np.concatenate([pair // T, pair % T]), minlength=T)
    seen = np.isfinite(tracks.nis) & (others == 1)
    return np.asarray(~(sure & seen[first] & seen[second]))


def _distance_squared(
    mean: Floats, P: Floats, first: Ints, second: Ints, dt: Floats, space: Space, part: slice
) -> Floats:
    """
    Return the squared distance of this part of track pairs, at the time of the second.

    Covariances are not moved: doubles wait for each other (`update._due`), so their looks are at
    almost the same time, also where the antenna passes from one turn to the next.
    """
    delta = take_rows(mean, second) - take_rows(mean, first)
    delta[:, 0::2] -= take_rows(mean[:, 1::2], first) * dt[:, None]
    delta, P = space.shortest(delta)[:, part], P[:, part, part]
    total = take_rows(P, first) + take_rows(P, second)
    return np.asarray(np.einsum('ki,kij,kj->k', delta, inverse(total)[0], delta))


def _rank(tracks: Tracks) -> Ints:
    """Return places (T,): confirmed before tentative, then by hits, then by age."""
    order = np.lexsort((tracks.id, -tracks.hits, ~tracks.confirmed))
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    return rank
