# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots fall into which gates, and how likely are they there?"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import gammaincinv

from tracking_core import measurement
from tracking_core.batches import Coverage, Floats, Innovations, Ints, Mixture, Pairs, Scan
from tracking_core.composition import Plane
from tracking_core.gating import box_pairs
from tracking_core.kalman import mixture_log_likelihood
from tracking_core.rows import take
from tracking_core.sensing import Sensor

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
    velocity_variance: Floats  # (T, d)


@dataclass(frozen=True)
class Gated:
    """The pairs inside the gates."""

    pairs: Pairs
    innovations: tuple[Innovations, ...]  # one per plane
    distance: Floats  # (P,) least Mahalanobis distance squared of any mode
    log_likelihood: Floats  # (P,) product over planes of the mode mixtures


@lru_cache(maxsize=64)
def thresholds(probability: float, dimensions: int) -> Floats:
    """Return chi-square bounds by number of components of a plot, 0 to `dimensions` + 1."""
    halves = 0.5 * np.arange(1, dimensions + 2)
    return np.concatenate([[0.0], 2.0 * gammaincinv(halves, probability)])


def open_gates(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    sensor: Sensor,
    coverage: Coverage,
    threshold: float,
) -> Gates:
    """
    Return the gate of every track, from the predicted modes and the noise expected there.

    References
    ----------
    [ZHUK09]: centre and 3-sigma size from the predicted mixture, with spread, plus R.

    """
    T, d = len(mixtures[0].mean), sensor.dimensions
    mean, variance = np.zeros((T, d)), np.zeros((T, d))
    velocity, velocity_variance = np.zeros((T, d)), np.zeros((T, d))
    moments = [mixture.moments() for mixture in mixtures]
    for plane, (m, P) in zip(planes, moments, strict=True):
        at, diagonal = list(plane.coordinates), np.einsum('tnn->tn', P)
        mean[:, at], velocity[:, at] = m[:, 0::2], m[:, 1::2]
        variance[:, at], velocity_variance[:, at] = diagonal[:, 0::2], diagonal[:, 1::2]
    R = sensor.noise(mean, coverage)
    low, high = np.empty((T, d)), np.empty((T, d))
    volume = np.full(T, _UNIT_BALL[d] * threshold ** (0.5 * d))
    for plane, mixture, (_, P) in zip(planes, mixtures, moments, strict=True):
        at = list(plane.coordinates)
        noise = R[:, at][:, :, at]
        spread = np.einsum('tjnn->tjn', mixture.covariance)[..., 0::2]
        half = np.sqrt(threshold * (spread + np.einsum('tdd->td', noise)[:, None]))
        low[:, at] = (mixture.mean[..., 0::2] - _BOX_MARGIN * half).min(axis=1)
        high[:, at] = (mixture.mean[..., 0::2] + _BOX_MARGIN * half).max(axis=1)
        volume *= np.sqrt(np.maximum(np.linalg.det(P[:, 0::2, 0::2] + noise), 0.0))
    three_sigma = 3.0 * np.sqrt(variance + np.einsum('tdd->td', R))
    centre = 0.5 * (low + high)
    return Gates(centre, high - centre, three_sigma, volume, velocity, velocity_variance)


def pair(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    gates: Gates,
    time: Floats,
    longest_lag: Floats,
    scan: Scan,
    bounds: Floats,
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

    """
    reach = gates.half_size + np.abs(gates.velocity) * longest_lag[:, None]
    track, plot = box_pairs(gates.centre, reach, scan.position)
    lag = scan.time[plot] - time[track]
    near = np.abs(lag) <= longest_lag[track] + 1e-9
    pairs = Pairs(track[near], plot[near], lag[near])
    gated, dof = _innovate(planes, mixtures, gates, pairs, scan)
    return take(gated, gated.distance <= bounds[dof])


def _innovate(
    planes: tuple[Plane, ...],
    mixtures: tuple[Mixture, ...],
    gates: Gates,
    pairs: Pairs,
    scan: Scan,
) -> tuple[Gated, Ints]:
    """Compare all candidates with their predictions; count the components of each plot."""
    has_range_rate = bool(np.isfinite(scan.range_rate).any())
    distance, log_likelihood = np.zeros(len(pairs)), np.zeros(len(pairs))
    dof, innovations = np.zeros(len(pairs), np.int64), []
    for plane, mixture in zip(planes, mixtures, strict=True):
        measured = measurement.of_plane(plane.coordinates, pairs, scan)
        if has_range_rate and 0 in plane.coordinates:
            measured = measurement.with_range_rate(
                measured, plane.coordinates, pairs, scan,
                gates.velocity[pairs.track], gates.velocity_variance[pairs.track],
            )  # fmt: skip
        item = plane.estimator.innovate(mixture, pairs.track, measured)
        innovations.append(item)
        distance += item.distance.min(axis=1)
        log_likelihood += mixture_log_likelihood(mixture.mode_probability[pairs.track], item)
        dof += measured.value.shape[1] - measured.absent
    return Gated(pairs, tuple(innovations), distance, log_likelihood), dof
