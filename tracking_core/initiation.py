# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where do tracks come from? From two unclaimed plots of successive looks, or from one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Coverage, Floats, Ints, Seeds
from tracking_core.density import Density
from tracking_core.faint_starts import share_of_faint, worth_a_track
from tracking_core.interval import time_of_turns
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.looks import longest_since, looks_since
from tracking_core.new_contacts import limits, Odds, share_of_new, velocity_covariance
from tracking_core.rows import change, take, take_rows
from tracking_core.space import POINTS, Space

_MOST_PAIRS = 1_000_000  # of plots looked at; the last seeds go without
_NOISE_SIGMAS = 3.0  # by how much of the plots' noise the speed limit is widened


@dataclass(frozen=True)
class Starts:
    """New tracks: K means and covariances per coordinate pair, and where they come from."""

    mean: Floats  # (K, d, 2) position and velocity of each coordinate
    covariance: Floats  # (K, d, 2, d, 2)
    existence_probability: Floats  # (K,)
    plot: Ints  # (K,) row of the newest plot
    hits: int  # plots that each start is made of
    leniency: float = 1.0  # they may be so much less likely than usual

    @staticmethod
    def none(d: int) -> Starts:
        """Return no start in d coordinates."""
        nothing = np.zeros((0, d, 2))
        return Starts(
            nothing, np.zeros((0, d, 2, d, 2)), nothing[:, 0, 0], np.zeros(0, np.int64), 0
        )


def one_point(fresh: Seeds, existence: Floats | float, config: InitiationConfig) -> Starts:
    """
    Start a track on every plot, at rest, with a velocity prior as wide as the speed limit.

    The prior is Gaussian with the variance of velocities even within the limit.
    """
    K, d = fresh.position.shape
    mean, covariance = np.zeros((K, d, 2)), np.zeros((K, d, 2, d, 2))
    mean[:, :, 0] = fresh.position
    covariance[:, :, 0, :, 0] = fresh.covariance
    covariance[:, :, 1, :, 1] = velocity_covariance(d, config)
    return Starts(mean, covariance, existence * fresh.free, np.arange(K), 1)


def two_point(
    seeds: Seeds,
    fresh: Seeds,
    density: Density,
    coverage: Coverage,
    interval: float,
    detection_probability: float,
    least_existence: float,
    config: InitiationConfig,
    space: Space = POINTS,
) -> Starts:
    """
    Start a track on every pair of an older and a fresh plot that keeps the speed limit.

    Parameters
    ----------
    seeds, fresh : Seeds
        Older and fresh unclaimed plots.
    density : Density
        Of false plots and of new contacts, in plot space.
    coverage : Coverage
        What the scan of the fresh plots swept.
    interval : float
        Time between two looks [s]; plots of one look make no pair.
    detection_probability : float
        P_D.
    least_existence : float
        Pairs less likely than this are usually not worth a track. In clutter so dense that two
        plots of a contact seldom are, the likeliest `faint_starts` of the fainter pairs are, too.
    config : InitiationConfig
        Speed limits, and how many faint starts.
    space : Space
        Where the plots are.

    Returns
    -------
    Starts
        P = [R1, R1/T; R1/T, (R0 + R1)/T^2] per [ZHUK09] section 4, for full R.

    """
    odds = Odds(density, detection_probability, config)
    looks = looks_since(seeds.time, seeds.position, interval, coverage)
    hopeful, leniency = odds.can_start(seeds, looks, interval, least_existence)
    seeds, first = take(seeds, hopeful), looks[hopeful] == 1.0

    old, new, step, dt = _within_reach(seeds, fresh, coverage, interval, config, space)
    if len(old) == 0:
        return change(Starts.none(step.shape[1]), leniency=leniency)
    looks_between = np.maximum(np.rint(dt / interval) - 1.0, 0.0)
    noise = take_rows(seeds.covariance, old) + take_rows(fresh.covariance, new)
    likely = odds.of_plots(fresh)[new] * odds.of_steps(noise, step, dt)
    likely *= (1.0 - detection_probability) ** looks_between
    evidence = np.bincount(old, likely, len(seeds)) - detection_probability
    usual = density.existence(1.0)
    thinner = density.existence(seeds.relief) / usual
    prior = share_of_new(usual, thinner, np.asarray(evidence), seeds.free, first) * seeds.free
    existence = prior[old] * likely / (1.0 + prior * evidence)[old]
    most_faint = share_of_faint(config.faint_starts, coverage, density)
    keep = worth_a_track(existence, least_existence, leniency, most_faint)
    starts = _starts(
        take_rows(seeds.covariance, old[keep]), take_rows(fresh.covariance, new[keep]),
        take_rows(fresh.position, new[keep]), take_rows(step, keep), dt[keep], existence[keep],
        new[keep],
    )  # fmt: skip
    return change(starts, leniency=leniency)


def _within_reach(
    seeds: Seeds, fresh: Seeds, coverage: Coverage, interval: float, config: InitiationConfig,
    space: Space,
) -> tuple[Ints, Ints, Floats, Floats]:  # fmt: skip
    """Return the rows (K,), (K,) of pairs, how far (K, d) they are apart and how long (K,) [s]."""
    d = seeds.position.shape[1]
    if len(seeds) == 0 or len(fresh) == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, d)), np.zeros(0)
    longest = longest_since(seeds.time, fresh.time.max(), coverage)
    variances = [plots.covariance.diagonal(0, 1, 2) for plots in (seeds, fresh)]
    noise = _NOISE_SIGMAS * np.sqrt(variances[0] + variances[1].max(axis=0))
    reach = (limits(d, config)[:, None] * longest).T + noise
    old, new = space.find_pairs(seeds.position, reach, fresh.position, _MOST_PAIRS)
    dt = fresh.time[new] - seeds.time[old]
    step = space.shortest(take_rows(fresh.position, new) - take_rows(seeds.position, old))
    noise = _NOISE_SIGMAS * np.sqrt(take_rows(variances[0], old) + take_rows(variances[1], new))
    slack = np.maximum(np.abs(step) - noise, 0.0)
    horizontal = slack[:, 0] if d == 1 else np.hypot(slack[:, 0], slack[:, 1])
    fits = (horizontal <= config.speed_max * dt) & (dt > 0.5 * interval)
    fits &= dt < time_of_turns(int(config.memory), coverage)
    for axis in range(2, d):
        fits &= slack[:, axis] <= config.climb_max * dt
    kept = fits.nonzero()[0]
    return old[kept], new[kept], take_rows(step, kept), dt[kept]


def _starts(
    R0: Floats, R1: Floats, position: Floats, step: Floats, dt: Floats, existence: Floats,
    plot: Ints,
) -> Starts:  # fmt: skip
    """Return the starts from pairs of plots with covariances R0, then R1 at `position`."""
    K, d = step.shape
    mean, covariance = np.empty((K, d, 2)), np.empty((K, d, 2, d, 2))
    mean[:, :, 0] = position
    mean[:, :, 1] = step / dt[:, None]
    over_dt = R1 / dt[:, None, None]
    covariance[:, :, 0, :, 0] = R1
    covariance[:, :, 1, :, 1] = (R0 + R1) / dt[:, None, None] ** 2
    covariance[:, :, 0, :, 1] = covariance[:, :, 1, :, 0] = over_dt
    return Starts(mean, covariance, existence, plot, 2)


def plane_start(starts: Starts, coordinates: tuple[int, ...]) -> tuple[Floats, Floats]:
    """Return mean (K, n) and covariance (K, n, n) of these coordinates, as an estimator starts."""
    K, n = len(starts.mean), 2 * len(coordinates)
    at = slice(coordinates[0], coordinates[-1] + 1)
    covariance = starts.covariance[:, at, :, at]
    return starts.mean[:, at].reshape(K, n), covariance.reshape(K, n, n)
