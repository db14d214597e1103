# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where is the plot that several contacts have in common?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.partitions import Partitions
from tracking_core.batches import Floats, Ints, Mixture
from tracking_core.composition import Plane
from tracking_core.pairing import axes_of
from tracking_core.space import Space
from tracking_core.unresolved.grouping import Groups
from tracking_core.unresolved.resolution import Places

_LOG_PER_DECIBEL = 0.1 * np.log(10.0)


@dataclass(frozen=True)
class Common:
    """Sets of tracks that may have a plot in common, and the plots in their gates."""

    partitions: Partitions
    existence_apart: Floats  # (T,) of tracks that are in no set
    size: Ints  # (U,) number of tracks of each unit; the first T units are the tracks
    unit: Ints  # (Q,) pairs of a set of tracks and a plot, sorted by unit
    plot: Ints  # (Q,)
    log_likelihood: Floats  # (Q,)
    law_pair: Ints  # (R,) of a law by which a track may have a part in it
    law_part: Floats  # (R,) chance of the law, given the pair
    law_size: Ints  # (R,) number of tracks that the law is of
    hidden_pair: Ints  # (H,) in such a pair ...
    hidden_track: Ints  # (H,) ... this track ...
    hidden_part: Floats  # (H,) ... is drowned with this chance


@dataclass(frozen=True)
class Sets:
    """Sets of tracks as one contact, in the coordinates of the plots."""

    start: Ints  # (B,) first row of each among the groups' members
    size: Ints  # (B,)
    mean: Floats  # (B, d)
    covariance: Floats  # (B, d, d) of the mean
    spread: Floats  # (B, d, d) of the tracks about it
    velocity: Floats  # (B, d)
    share: Floats  # (N,) of each member in the mean
    place: Floats  # (N, d) of each member, within half a turn of the mean


def places_of(planes: tuple[Plane, ...], mixtures: tuple[Mixture, ...], d: int) -> Places:
    """Return where T tracks are, in the d coordinates of the plots."""
    T = len(mixtures[0].mean)
    mean, covariance, velocity = np.zeros((T, d)), np.zeros((T, d, d)), np.zeros((T, d))
    for plane, mixture in zip(planes, mixtures, strict=True):
        m, P = mixture.moments()
        at = np.array(plane.coordinates)
        place, rate = axes_of(plane.coordinates)
        mean[:, at], velocity[:, at] = m[:, place], m[:, rate]
        covariance[:, at[:, None], at] = P[:, place, place]
    return Places(mean, covariance, velocity)


def as_one(places: Places, groups: Groups, level: Floats, space: Space) -> Sets:
    """Average the tracks of each set by their level (T,) [dB], NaN where it is not known."""
    start = np.flatnonzero(np.diff(groups.unit, prepend=-1))
    of, member = groups.unit - groups.unit[0], groups.member
    power = _known_power(level[member], of, len(start))
    share = power / np.bincount(of, power)[of]
    place = places.mean[member]
    place = space.beside(place, place[start], of)

    def total(values: Floats) -> Floats:
        return np.add.reduceat(values, start, axis=0)

    mean = total(share[:, None] * place)
    offset = place - mean[of]
    return Sets(
        start=start,
        size=np.bincount(of),
        mean=mean,
        covariance=total(share[:, None, None] ** 2 * places.covariance[member]),
        spread=total(share[:, None, None] * offset[:, :, None] * offset[:, None, :]),
        velocity=total(share[:, None] * places.velocity[member]),
        share=share,
        place=place,
    )


def _known_power(level: Floats, of: Ints, sets: int) -> Floats:
    """Return linear levels (N,), the mean of the set for those that are not known."""
    known = np.isfinite(level)
    count = np.bincount(of, known, sets)
    mean = np.bincount(of, np.where(known, level, 0.0), sets) / np.maximum(count, 1.0)
    return np.asarray(np.exp(_LOG_PER_DECIBEL * np.where(known, level, mean[of])))
