# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How does one alpha-beta filter look to a tracker when its gain is raised in manoeuvres?

As two modes with the same mean. The quiet one is the filter. The other is as vague as a filter
with the manoeuvre's gain: it opens the gates for the plots that the detector waits for. How far
the gain is raised, 0 to 1, is published as the probability of the second mode.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tracking_core.alpha_beta import GainFilter
from tracking_core.batches import Association, Bools, Floats, Innovations, Ints, Mixture
from tracking_core.chances import MORE_LIKELY_THAN_NOT
from tracking_core.gains import noise_gain, on_axes, steady_covariance
from tracking_core.linalg import sum_by_track


@dataclass(frozen=True)
class ControlledGain:
    """One alpha-beta filter whose gain an estimator controls."""

    quiet_alpha: float
    manoeuvre_alpha: float  # sizes the gates for manoeuvres
    axes: int
    reading: str = 'steady_state'
    stay_probability: float = 0.9  # of a look to be as quiet as the one before

    def __post_init__(self) -> None:
        GainFilter((self.quiet_alpha, self.manoeuvre_alpha), self.axes, self.reading)

    @property
    def gains(self) -> GainFilter:
        """The filter itself."""
        return GainFilter((self.quiet_alpha,), self.axes, self.reading)

    def start(self, mean: Floats, covariance: Floats, extra: int) -> Mixture:
        """Return quiet new tracks with so many columns of memory for the control."""
        single = self.gains.start(mean, covariance, extra)
        return two_modes(single, np.zeros(len(mean)))

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move the filter over the times dt (T,) [s]; open the second mode."""
        raised = mixture.mode_probability[:, 1]
        single = self.gains.predict(quiet(mixture), dt)
        chance = raised * self.stay_probability + (1.0 - raised) * (1.0 - self.stay_probability)
        both = two_modes(single, chance)
        vague, _ = steady_covariance(self.manoeuvre_alpha)
        interval, noise = self.gains.interval(single), self.gains.plot_noise(single)
        both.covariance[:, 1] += on_axes(noise, vague[None], interval)[:, 0]
        return both

    def update(
        self,
        mixture: Mixture,
        track: Ints,
        innovations: Innovations,
        association: Association,
        alpha: Floats,
    ) -> Mixture:
        """Correct the filter with gains alpha (T,); the answer has one mode."""
        single, first, gain = quiet(mixture), of_quiet(innovations), alpha[:, None]
        after = self.gains.update(single, track, first, association, gain)
        return self.gains.admit_lag(after, single, track, first, association, gain)

    def settled_distance(
        self, mixture: Mixture, track: Ints, innovations: Innovations, alpha: Floats
    ) -> Floats:
        """Return nu^T S^-1 nu (P,) with the S of filters settled at alpha (T,) on plot noise."""
        single, first = quiet(mixture), of_quiet(innovations)
        R = self.gains.noise_of_pairs(single, track, first)
        nu = first.innovation[:, 0, : self.axes]
        squared = (nu * np.linalg.solve(R, nu[..., None])[..., 0]).sum(axis=1)
        return np.asarray(squared / (1.0 + noise_gain(alpha[track])))

    def control(self, mixture: Mixture) -> Floats:
        """Return what the control remembers (T, extra)."""
        return mixture.memory[:, self.gains.columns :]

    def with_control(self, single: Mixture, raised: Floats, columns: Floats) -> Mixture:
        """Return the filter as two modes, the gain `raised` (T,), with the control's memory."""
        memory = single.memory.copy()
        memory[:, self.gains.columns :] = columns
        return two_modes(replace(single, memory=memory), raised)


def quiet(mixture: Mixture) -> Mixture:
    """Return the filter without the mode that opens the gates."""
    return Mixture(
        mixture.mean[:, :1], mixture.covariance[:, :1], np.ones((len(mixture.mean), 1)),
        mixture.memory,
    )  # fmt: skip


def of_quiet(innovations: Innovations) -> Innovations:
    """Return the innovations without those of the mode that opens the gates."""
    return Innovations(
        innovations.innovation[:, :1],
        innovations.covariance[:, :1],
        innovations.distance[:, :1],
        innovations.log_likelihood[:, :1],
        innovations.cross_covariance[:, :1],
        innovations.noise,
    )


def two_modes(single: Mixture, raised: Floats) -> Mixture:
    """Return a filter as two equal modes, the second with probability `raised` (T,)."""
    return Mixture(
        np.repeat(single.mean, 2, axis=1),
        np.repeat(single.covariance, 2, axis=1),
        np.stack([1.0 - raised, raised], axis=1),
        single.memory,
    )


def surprise(distance: Floats, track: Ints, association: Association) -> tuple[Floats, Bools]:
    """
    Return the mean squared distance of each track's plots (T,), and which tracks have a plot.

    Parameters
    ----------
    distance : (P,) array
        Mahalanobis squared, in whatever covariance.
    track : (P,) array
        Row of each pair's track, sorted.
    association : Association
        Weights of the pairs.

    """
    T = len(association.miss)
    found = 1.0 - association.miss
    total = sum_by_track(association.probability * distance, track, T)
    hit = np.asarray(found > MORE_LIKELY_THAN_NOT)
    return np.where(hit, total / np.maximum(found, MORE_LIKELY_THAN_NOT), 0.0), hit
