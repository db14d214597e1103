# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How near must two contacts be to have one plot in common, and how likely are they that near?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.special import ndtr

from tracking_core.batches import Bools, Coverage, Floats, Ints
from tracking_core.chances import TINY
from tracking_core.space import Space
from tracking_core.unresolved.grouping import Links

_SIGMAS = 3.0  # tracks further apart than the limit and so many sd are not looked at
_LARGEST_CHANCE = 1.0 - 1e-6  # nothing is certain: the logarithm of what is left must be finite


class Resolving(Protocol):
    """A sensor that says when contacts are unresolved."""

    @property
    def space(self) -> Space:
        """Where its plots are: points or angles."""
        ...

    def separation(self, first: Floats, second: Floats, coverage: Coverage) -> Floats:
        """Return (P, c): how far apart, in units of the limit, in each of c coordinates."""
        ...

    def reach(self, position: Floats, coverage: Coverage) -> Floats:
        """Return (T, d): half size of the box that holds all that may be one with a contact."""
        ...


@dataclass(frozen=True)
class Resolution:
    """What is known of unresolved plots."""

    sensor: Resolving
    softness: float  # sd of the limit, as a part of it
    spread: float  # variance of a common plot about its mean, as a part of the contacts' spread
    interference: float  # sd of plots of contacts near each other, as a part of the limit
    capture: float  # chance that one contact drowns the others
    least_chance: float  # contacts less likely to be one are taken as apart


@dataclass(frozen=True)
class Places:
    """Where the tracks are, in the coordinates of the plots."""

    mean: Floats  # (T, d)
    covariance: Floats  # (T, d, d)
    velocity: Floats  # (T, d)


def near_pairs(
    places: Places, coverage: Coverage, resolution: Resolution
) -> tuple[Ints, Ints, Floats]:
    """Return the tracks (L,), (L,) that may be one, and the chance (L,) that they are."""
    sd = np.sqrt(np.einsum('tdd->td', places.covariance))
    # Each looks as far as the pair may be apart if it is the vaguer one of the two.
    reach = resolution.sensor.reach(places.mean, coverage) * (1.0 + _SIGMAS * resolution.softness)
    reach = reach + 2.0 * _SIGMAS * sd
    one, other = resolution.sensor.space.find_pairs(places.mean, reach, places.mean)
    T, apart = len(sd), one != other
    pairs = np.unique((np.minimum(one, other) * T + np.maximum(one, other))[apart])
    first, second = np.divmod(pairs, max(T, 1))
    chance = _chance(places, first, second, coverage, resolution)
    keep = chance >= resolution.least_chance
    return first[keep], second[keep], np.minimum(chance[keep], _LARGEST_CHANCE)


def interference(
    places: Places, links: Links, coverage: Coverage, resolution: Resolution
) -> Floats:
    """Return the noise (T, d, d) of plots that a neighbour pulls at, 0 without one."""
    chance = np.zeros(len(places.mean))
    for one in (links.first, links.second):
        np.maximum.at(chance, one, links.chance)
    sd = resolution.interference * resolution.sensor.reach(places.mean, coverage)
    return chance[:, None, None] * sd[:, :, None] ** 2 * np.eye(sd.shape[1])


def within_limit(
    contacts: Floats, plots: Floats, coverage: Coverage, resolution: Resolution
) -> Bools:
    """Return which plots (M, d) are nearer than the limit to one of the contacts (T, d)."""
    sensor = resolution.sensor
    track, plot = sensor.space.find_pairs(contacts, sensor.reach(contacts, coverage), plots)
    apart = sensor.separation(contacts[track], plots[plot], coverage)
    near = np.zeros(len(plots), bool)
    near[plot[(np.abs(apart) < 1.0).all(axis=1)]] = True
    return near


def _chance(
    places: Places, first: Ints, second: Ints, coverage: Coverage, resolution: Resolution
) -> Floats:
    """Return the chance (L,) of being within the limit, a Gaussian in each of its coordinates."""
    a, b = places.mean[first], places.mean[second]
    apart = resolution.sensor.separation(a, b, coverage)
    P = places.covariance[first] + places.covariance[second]
    sd = np.sqrt(np.einsum('ldd->ld', P))
    slope = np.empty((*apart.shape, a.shape[1]))
    for axis in range(a.shape[1]):
        step = np.zeros_like(a)
        step[:, axis] = sd[:, axis]
        further = resolution.sensor.separation(a, b + step, coverage)
        slope[..., axis] = (further - apart) / np.maximum(sd[:, None, axis], TINY)
    spread = np.sqrt(np.einsum('lca,lab,lcb->lc', slope, P, slope) + resolution.softness**2)
    inside = ndtr((1.0 - apart) / spread) - ndtr((-1.0 - apart) / spread)
    return np.asarray(inside.prod(axis=1))
