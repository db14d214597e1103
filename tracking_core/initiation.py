# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where do tracks come from? From two unclaimed plots of successive looks, or from one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Ints, Seeds
from tracking_core.composition import Density
from tracking_core.gating import box_pairs
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.rows import take

_NOISE_SIGMAS = 3.0  # by how much of the plots' noise the speed limit is widened


@dataclass(frozen=True)
class Starts:
    """New tracks: K means and covariances per coordinate pair, and where they come from."""

    mean: Floats  # (K, d, 2) position and velocity of each coordinate
    covariance: Floats  # (K, d, 2, d, 2)
    existence_probability: Floats  # (K,)
    plot: Ints  # (K,) row of the newest plot
    hits: int  # plots that each start is made of

    @staticmethod
    def none(d: int) -> Starts:
        """Return no start in d coordinates."""
        nothing = np.zeros((0, d, 2))
        return Starts(
            nothing, np.zeros((0, d, 2, d, 2)), nothing[:, 0, 0], np.zeros(0, np.int64), 0
        )


def one_point(fresh: Seeds, existence: float, config: InitiationConfig) -> Starts:
    """
    Start a track on every plot, at rest, with a velocity prior as wide as the speed limit.

    The prior is Gaussian with the variance of a uniform one in each coordinate.
    """
    K, d = fresh.position.shape
    mean, covariance = np.zeros((K, d, 2)), np.zeros((K, d, 2, d, 2))
    mean[:, :, 0] = fresh.position
    covariance[:, :, 0, :, 0] = fresh.covariance
    axis = np.arange(d)
    covariance[:, axis, 1, axis, 1] = _limits(d, config) ** 2 / 3.0
    return Starts(mean, covariance, existence * fresh.free, np.arange(K), 1)


def two_point(
    seeds: Seeds,
    fresh: Seeds,
    density: Density,
    interval: float,
    detection_probability: float,
    least_existence: float,
    config: InitiationConfig,
) -> Starts:
    """
    Start a track on every pair of an older and a fresh plot that keeps the speed limit.

    Parameters
    ----------
    seeds, fresh : Seeds
        Older and fresh unclaimed plots.
    density : Density
        Of false plots and of new contacts, in plot space.
    interval : float
        Time between two looks [s]; plots of one look make no pair.
    detection_probability : float
        P_D.
    least_existence : float
        Pairs less likely than this are not worth a track; dense clutter starts nothing.
    config : InitiationConfig
        Speed limits.

    Returns
    -------
    Starts
        P = [R1, R1/T; R1/T, (R0 + R1)/T^2] per [ZHUK09] section 4, for full R.

    """
    odds = _Odds(density, detection_probability, config)
    alone = odds.of_pair(seeds, seeds, np.full(len(seeds), interval))
    prior = density.existence * seeds.free
    seeds = take(seeds, prior * alone >= least_existence * (1.0 - prior + prior * alone))
    prior = density.existence * seeds.free

    old, new = _within_reach(seeds, fresh, 0.5 * interval, config)
    dt = fresh.time[new] - seeds.time[old]
    looks_between = np.maximum(np.rint(dt / interval) - 1.0, 0.0)
    likely = odds.of_pair(take(seeds, old), take(fresh, new), dt)
    likely = likely * (1.0 - detection_probability) ** looks_between
    missed = 1.0 - prior * detection_probability
    total = missed + prior * np.bincount(old, likely, len(seeds))
    existence = prior[old] * likely / total[old]
    keep = existence >= least_existence
    return _starts(seeds, fresh, old[keep], new[keep], existence[keep])


@dataclass(frozen=True)
class _Odds:
    """How much likelier a second plot is when the first was a contact's than when it was not."""

    density: Density
    detection_probability: float
    config: InitiationConfig

    def of_pair(self, first: Seeds, second: Seeds, dt: Floats) -> Floats:
        """Return P_D over the number of other plots within reach after dt (K,) [s]."""
        volume = _reachable_volume(first.covariance, dt, self.config)
        others = self.density.total * second.clutter_volume * volume
        return self.detection_probability * second.free / np.maximum(others, 1e-300)


def _within_reach(
    seeds: Seeds, fresh: Seeds, shortest: float, config: InitiationConfig
) -> tuple[Ints, Ints]:
    if len(seeds) == 0 or len(fresh) == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    longest = np.maximum(fresh.time.max() - seeds.time, 0.0)
    noise = _NOISE_SIGMAS * np.sqrt(
        _variances(seeds.covariance) + _variances(fresh.covariance).max(axis=0)
    )
    limit = _limits(seeds.position.shape[1], config)
    old, new = box_pairs(seeds.position, limit * longest[:, None] + noise, fresh.position)
    dt = (fresh.time[new] - seeds.time[old])[:, None]
    noise = _NOISE_SIGMAS * np.sqrt(
        _variances(seeds.covariance)[old] + _variances(fresh.covariance)[new]
    )
    step = np.abs(fresh.position[new] - seeds.position[old])
    slack = np.maximum(step - noise, 0.0)
    fits = np.linalg.norm(slack[:, :2], axis=1) <= config.speed_max * dt[:, 0]
    fits &= dt[:, 0] > shortest
    fits &= (slack[:, 2:] <= config.climb_max * dt).all(axis=1)
    return old[fits], new[fits]


def _limits(d: int, config: InitiationConfig) -> Floats:
    return np.array([config.speed_max] * min(d, 2) + [config.climb_max] * (d - 2))


def _variances(covariance: Floats) -> Floats:
    return np.asarray(np.einsum('mdd->md', covariance))


def _reachable_volume(covariance: Floats, dt: Floats, config: InitiationConfig) -> Floats:
    """Return the volume (K,) in which the second plot of a contact would lie."""
    sd = np.sqrt(_variances(covariance))
    across = config.speed_max * dt + sd[:, :2].mean(axis=1)
    if covariance.shape[1] == 1:
        return np.asarray(2.0 * across)
    volume = np.pi * across**2
    if covariance.shape[1] == 3:
        volume = volume * 2.0 * (config.climb_max * dt + _NOISE_SIGMAS * sd[:, 2])
    return np.asarray(volume)


def _starts(seeds: Seeds, fresh: Seeds, old: Ints, new: Ints, existence: Floats) -> Starts:
    dt = (fresh.time[new] - seeds.time[old])[:, None]
    R0, R1 = seeds.covariance[old], fresh.covariance[new]
    K, d = len(old), fresh.position.shape[1]
    mean, covariance = np.empty((K, d, 2)), np.empty((K, d, 2, d, 2))
    mean[:, :, 0] = fresh.position[new]
    mean[:, :, 1] = (fresh.position[new] - seeds.position[old]) / dt
    over_dt = R1 / dt[..., None]
    covariance[:, :, 0, :, 0], covariance[:, :, 1, :, 1] = R1, (R0 + R1) / dt[..., None] ** 2
    covariance[:, :, 0, :, 1] = covariance[:, :, 1, :, 0] = over_dt
    return Starts(mean, covariance, existence, new, 2)


def plane_start(starts: Starts, coordinates: tuple[int, ...]) -> tuple[Floats, Floats]:
    """Return mean (K, n) and covariance (K, n, n) of these coordinates, as an estimator starts."""
    at, K, n = list(coordinates), len(starts.mean), 2 * len(coordinates)
    covariance = starts.covariance[:, at][:, :, :, at]
    return starts.mean[:, at].reshape(K, n), covariance.reshape(K, n, n)
