# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How likely are two unclaimed plots a new contact, rather than two strange plots?"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tracking_core.batches import Bools, Floats, Seeds
from tracking_core.chances import TINY
from tracking_core.density import Density
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.linalg import determinant, inverse
from tracking_core.rows import take

MOST_NEW = 0.9  # share of the unclaimed plots that new contacts can have made
_STEPS = 5  # of expectation and maximisation
_FAINTER = 0.1  # than at rest: a pair of a contact that moves, or was missed between
_MOST_MORE = 2.0  # new contacts than expected: so many a plot missed since may be thought to be
_MOST_LENIENT = 1000.0  # in clutter that is denser still nothing can be followed
_TRUST = 200.0  # plots that the expected share of new contacts counts for


def share_of_new(
    expected: float, likely: Floats, evidence: Floats, free: Floats, looked_at: Bools
) -> Floats:
    """
    Return which share of the unclaimed plots (S,) new contacts made.

    It is `expected` where the clutter is as dense as on the mean, `likely` (S,) times that in
    thinner or denser clutter.

    The expected share is what the parameters say of contacts that come one by one. After a start,
    or when a whole formation appears, it is far too small, and the pairs themselves tell: a few
    steps of expectation and maximisation, held back by the expectation for want of evidence. Only
    plots `looked_at` (S,) just once more tell: in a sector most are elsewhere, and those that are
    left of earlier looks are fewer of contacts, which were seen again and have tracks.
    """
    there, free, evidence = likely[looked_at], free[looked_at], evidence[looked_at]
    one, both = there * free * (1.0 + evidence), there * free * evidence
    share, plots = expected, float(there.sum())
    for _ in range(_STEPS):
        real = share * float((one / (1.0 + share * both)).sum())
        share = min((_TRUST * expected + real) / (_TRUST + plots), MOST_NEW)
    return np.minimum(share * likely, MOST_NEW)


@dataclass(frozen=True)
class Odds:
    """How much likelier a second plot is when the first was a contact's than when it was not."""

    density: Density
    detection_probability: float
    config: InitiationConfig

    def at_best(self, seeds: Seeds, dt: Floats | float) -> Floats:
        """Return the odds (S,) of a second plot just where the first is, dt [s] later."""
        spread = self._spread(2.0 * seeds.covariance, dt)
        return self.of_plots(seeds) * _peak(determinant(spread), spread.shape[1])

    def leniency(self, at_best: Floats, seeds: Seeds, least: float) -> float:
        """
        Return how much less likely than `least` new tracks may be, 1: not at all.

        In dense clutter two plots of a contact prove little; were they held to what is usual, no
        contact would ever be followed. `at_best` (S,) are the odds of the seeds.
        """
        if len(at_best) == 0:
            return 1.0
        both = self.density.existence(seeds.relief) * seeds.free * at_best
        middle = len(both) // 2
        usual = np.partition(both / (1.0 + both), middle)[middle]
        return float(np.clip(least / max(_FAINTER * usual, TINY), 1.0, _MOST_LENIENT))

    def can_start(
        self, seeds: Seeds, looks: Floats, interval: float, least: float
    ) -> tuple[Bools, float]:
        """
        Return which plots (S,) are worth a track with a second one just there, and the leniency.

        Parameters
        ----------
        seeds : Seeds
            Older plots.
        looks : (S,) array
            How many looks ago they were made, 0: this scan did not look there.
        interval : float
            From look to look [s].
        least : float
            Chance of a new track that is usually worth one.

        """
        alone, most = self.at_best(seeds, interval), MOST_NEW * seeds.free
        leniency = self.leniency(alone, seeds, least) if self.config.faint_starts else 1.0
        if leniency > 1.0:  # most plots of earlier looks are not worth it there
            old = (looks > 1.0).nonzero()[0]
            older, late = take(seeds, old), looks[old]
            missed = (1.0 - self.detection_probability) ** (late - 1.0)
            alone[old] = missed * self.at_best(older, late * interval)
            expected = self.density.existence(older.relief)
            most[old] = np.minimum(_MOST_MORE * expected, MOST_NEW) * older.free
        return most * alone >= least / leniency * (1.0 - most + most * alone), leniency

    def of_plots(self, plots: Seeds) -> Floats:
        """Return P_D over the density of other plots (M,), of plots that may be a contact's."""
        others = np.maximum(self.density.total(plots.relief) * plots.clutter_volume, TINY)
        return np.asarray(self.detection_probability * plots.free / others)

    def of_steps(self, noise: Floats, step: Floats, dt: Floats) -> Floats:
        """
        Return p(second | first) (K,), the density of a contact's second plot.

        The contact's velocity is taken as Gaussian with the variance that the speed limit gives;
        `step` (K, d) [m] apart after `dt` (K,) [s], with `noise` (K, d, d) of both plots.
        """
        inverted, size = inverse(self._spread(noise, dt))
        distance = np.einsum('kd,kde,ke->k', step, inverted, step)
        return np.asarray(_peak(size, step.shape[1]) * np.exp(-0.5 * distance))

    def _spread(self, noise: Floats, dt: Floats | float) -> Floats:
        """Return the covariance (K, d, d) of a step with this noise (K, d, d) after dt (K,)."""
        velocity = velocity_covariance(noise.shape[1], self.config)
        return np.asarray(noise + np.multiply.outer(velocity, dt * dt).T)


def _peak(size: Floats, d: int) -> Floats:
    """
    Return the greatest density (K,) of Gaussians in d coordinates, `size` = |covariance|.

    A size that rounding leaves at 0 or below is not known, and is no evidence of a contact: 0.
    """
    known = np.where(size > 0.0, size, np.inf)
    return np.asarray(1.0 / np.sqrt((2.0 * np.pi) ** d * known))


@lru_cache(maxsize=16)
def velocity_covariance(d: int, config: InitiationConfig) -> Floats:
    """Return the covariance (d, d) of velocities even within the limits; it cannot be changed."""
    variance = limits(d, config) ** 2 / 3.0  # on a line
    if d > 1:
        variance[:2] = config.speed_max**2 / 4.0  # on a disc
    if config.speed_sd > 0.0:
        variance[:2] = np.minimum(variance[:2], config.speed_sd**2)
    covariance = np.diag(variance)
    covariance.setflags(write=False)  # every caller gets this one
    return covariance


def limits(d: int, config: InitiationConfig) -> Floats:
    """Return the speed limit on each of d coordinates [m/s, sonar rad/s]."""
    return np.array([config.speed_max] * min(d, 2) + [config.climb_max] * (d - 2))
