# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots fall into which gates, and how likely are they there?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tracking_core import measurement
from tracking_core.batches import Floats, Innovations, Ints, Mixture, Pairs, Scan
from tracking_core.chances import chi_square_bound
from tracking_core.composition import Plane
from tracking_core.kalman import mixture_log_likelihood
from tracking_core.linalg import determinant, over_modes
from tracking_core.rows import take, take_rows
from tracking_core.sensing import Sensor
from tracking_core.slant import farther_out, over_ground
from tracking_core.space import Space

_UNIT_BALL = {1: 2.0, 2: np.pi, 3: 4.0 * np.pi / 3.0}
_BOX_MARGIN = 1.05  # the noise at the plot may exceed the noise at the prediction


@dataclass(frozen=True)
class Gates:
    """The gates of all tracks, in the coordinates of the plots."""

    centre: Floats  # (T, d)
    half_size: Floats  # (T, d) of the box that holds the gate of any mode
    three_sigma: Floats  # (T, d) half size of the 3-sigma gate of the predicted mixture
    volume: Floats  # (T,)
    velocity: Floats  # (T, d) predicted, of the mixture
    velocity_covariance: Floats  # (T, d, d) of velocities in one plane, 0 between planes


@dataclass(frozen=True)
class Gated:
    """The pairs inside the gates."""

    pairs: Pairs
    innovations: tuple[Innovations, ...]  # one per plane
    distance: Floats  # (P,) least Mahalanobis distance squared of any mode
    log_likelihood: Floats  # (P,) product over planes of the mode mixtures
    common: Ints  # (P,) row of the common plot that it is a part of, -1: the track's own plot


@lru_cache(maxsize=64)
def thresholds(probability: float, dimensions: int) -> Floats:
    """Return chi-square bounds by number of components of a plot, 0 to `dimensions` + 1."""
    bounds = [chi_square_bound(probability, count) for count in range(1, dimensions + 2)]
    return np.array([0.0, *bounds])


def open_gates(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    sensor: Sensor,
    scan: Scan,
    threshold: float,
) -> Gates:
    """
    Return the gate of every track, from the predicted modes and the noise expected there.

    The box holds the gates of the least sure plots, which may tell more noise than expected.

    References
    ----------
    [ZHUK09]: centre and 3-sigma size from the predicted mixture, with spread, plus R.

    """
    T, d = len(mixtures[0].mean), sensor.dimensions
    mean, variance, velocity, low, high = np.zeros((5, d, T)).swapaxes(1, 2)
    velocity_covariance = np.zeros((d, d, T)).T
    moments = [mixture.moments() for mixture in mixtures]
    for plane, (m, P) in zip(planes, moments, strict=True):
        at, diagonal = plane.part, P.diagonal(0, 1, 2)
        place, rate = axes_of(plane.coordinates)
        mean[:, at], velocity[:, at] = m[:, place], m[:, rate]
        variance[:, at], velocity_covariance[:, at, at] = diagonal[:, place], P[:, rate, rate]
    R, excess = sensor.noise(mean, scan.coverage), np.array(scan.excess)
    volume = np.full(T, _UNIT_BALL[d] * threshold ** (0.5 * d))
    for plane, mixture, (_, P) in zip(planes, mixtures, moments, strict=True):
        at, (place, _) = plane.part, axes_of(plane.coordinates)
        noise = R[:, at, at]
        spread = mixture.covariance.diagonal(0, 2, 3)[..., place]
        variance_here = spread + noise.diagonal(0, 1, 2)[:, None] + excess[at]
        variance_here = np.maximum(variance_here, 0.0)
        half = _BOX_MARGIN * np.sqrt(threshold * variance_here)
        low[:, at] = over_modes(np.minimum, mixture.mean[..., place] - half)
        high[:, at] = over_modes(np.maximum, mixture.mean[..., place] + half)
        volume *= np.sqrt(np.maximum(determinant(P[:, place, place] + noise), 0.0))
    three_sigma = 3.0 * np.sqrt(variance + R.diagonal(0, 1, 2))
    centre = 0.5 * (low + high)
    return Gates(centre, high - centre, three_sigma, volume, velocity, velocity_covariance)


def axes_of(coordinates: Sequence[int]) -> tuple[slice, slice]:
    """Return where positions and velocities stand in the state of a plane."""
    size = 2 * len(coordinates)
    return slice(0, size, 2), slice(1, size, 2)


def pair(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    gates: Gates,
    time: Floats,
    longest_lag: Floats,
    scan: Scan,
    bounds: Floats,
    space: Space,
) -> Gated:
    """
    Find the plots inside the gate of any mode.

    Parameters
    ----------
    planes, mixtures : tuples
        Estimators and predicted states of T tracks.
    gates : Gates
        Of the tracks.
    time : (T,) array
        For which the tracks are predicted [s].
    longest_lag : (T,) array
        Plots further away in time belong to another look [s].
    scan : Scan
        M plots.
    bounds : (d + 2,) array
        Chi-square bound by number of components.
    space : Space
        Where plots and gates are.

    """
    reach = gates.half_size + np.abs(gates.velocity) * longest_lag[:, None]
    reach[:, :2] += farther_out(gates.centre, scan)[:, None]
    track, plot = space.find_pairs(gates.centre, reach, scan.position)
    lag = scan.time[plot] - time[track]
    pairs = take(Pairs(track, plot, lag), np.abs(lag) <= longest_lag[track])
    position = plots_beside(pairs, gates, scan, space)
    gated, dof = _innovate(planes, mixtures, gates, pairs, scan, position)
    return take(gated, gated.distance <= bounds[dof])


def plots_beside(pairs: Pairs, gates: Gates, scan: Scan, space: Space) -> Floats:
    """Return the places (P, d) of the plots, told so as to be compared with their tracks."""
    position = space.beside(take_rows(scan.position, pairs.plot), gates.centre, pairs.track)
    return over_ground(position, pairs.plot, gates.centre[pairs.track, -1], scan)


def _innovate(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    gates: Gates,
    pairs: Pairs,
    scan: Scan,
    position: Floats,
) -> tuple[Gated, Ints]:
    """Compare all candidates with their predictions; count the components of each plot."""
    has_range_rate = bool(np.isfinite(scan.range_rate).any())
    distance, log_likelihood = np.zeros(len(pairs)), np.zeros(len(pairs))
    dof, innovations = np.zeros(len(pairs), np.int64), []
    place = position
    if has_range_rate:
        place = np.where(np.isnan(position), take_rows(gates.centre, pairs.track), position)
    for plane, mixture in zip(planes, mixtures, strict=True):
        measured = measurement.of_plane(plane.coordinates, pairs, scan, position)
        if has_range_rate and 0 in plane.coordinates:
            measured = measurement.with_range_rate(
                measured, plane.coordinates, pairs, scan, place,
                gates.velocity[pairs.track], take_rows(gates.velocity_covariance, pairs.track),
            )  # fmt: skip
        item = plane.estimator.innovate(mixture, pairs.track, measured)
        innovations.append(item)
        distance += over_modes(np.minimum, item.distance)
        log_likelihood += mixture_log_likelihood(
            take_rows(mixture.mode_probability, pairs.track), item
        )
        dof += measured.value.shape[1] - measured.absent
    own = np.full(len(pairs), -1)
    return Gated(pairs, tuple(innovations), distance, log_likelihood, own), dof
