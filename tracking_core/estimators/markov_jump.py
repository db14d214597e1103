# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The mixed-Markov (interacting multiple model) filter of one plane, the default estimator."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.kalman import condition, innovate
from tracking_core.linalg import over_modes, symmetrise
from tracking_core.mode_chain import Chain
from tracking_core.motion import Motion

_LEAST_WEIGHT = 1e-300  # a mode that cannot be reached starts from itself, not from 0/0


@dataclass(frozen=True)
class MarkovJump:
    """
    A contact jumps between linear motions as a Markov chain; one Gaussian follows each mode.

    References
    ----------
    [ZHUK09] eq. 18 to 24. For linear motions this is the IMM filter.

    """

    motions: tuple[Motion, ...]  # one per mode, the quiet mode first
    chain: Chain
    initial_probability: tuple[float, ...] = ()  # of the modes; empty: the chain's stationary

    def __post_init__(self) -> None:
        if len(self.motions) != self.chain.modes:
            raise ValueError(
                f'MarkovJump.motions must have one motion per mode of the chain, '
                f'{self.chain.modes}, got {len(self.motions)}'
            )

    @property
    def axes(self) -> int:
        """Number of axes; the state is (position, velocity) on each."""
        return self.motions[0].axes

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, n) and covariances (T, n, n), equal in all modes."""
        T, J = len(mean), len(self.motions)
        probability = np.array(self.initial_probability or self.chain.stationary)
        return Mixture(
            mean=np.repeat(mean[:, None], J, axis=1),
            covariance=np.repeat(covariance[:, None], J, axis=1),
            mode_probability=np.repeat(probability[None], T, axis=0),
            memory=np.zeros((T, 0)),
        )

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Mix the modes and move them over the times dt (T,) [s] (eq. 18 to 21)."""
        mixed = mix(mixture, self.chain.transition_probability(dt))
        F, Q = self._dynamics(dt, mixture.mean.shape[2])
        mean = np.einsum('tjab,tjb->tja', F, mixed.mean, order='F')
        moved = np.einsum('tjab,tjbc->tjac', F, mixed.covariance)
        covariance = symmetrise(np.einsum('tjac,tjdc->tjad', moved, F, order='F') + Q)
        return Mixture(mean, covariance, mixed.mode_probability, mixture.memory)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with every mode (eq. 22)."""
        return innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Update modes and mode probabilities (eq. 22 to 24)."""
        return condition(mixture, track, innovations, association)

    def _dynamics(self, dt: Floats, n: int) -> tuple[Floats, Floats]:
        F, Q = np.empty((len(dt), len(self.motions), n, n, 2), order='F').transpose(4, 0, 1, 2, 3)
        for mode, motion in enumerate(self.motions):
            F[:, mode], Q[:, mode] = motion.transition(dt), motion.process_noise(dt)
        return F, Q


def mix(mixture: Mixture, transition_probability: Floats) -> Mixture:
    """
    Start each mode from the mixture of the modes it may have come from.

    For linear motions, mixing before the prediction equals [ZHUK09]'s mixture after it, when
    both run through the motion of the new mode.

    Parameters
    ----------
    mixture : Mixture
        Posterior of the previous look, T tracks, J modes.
    transition_probability : (T, J, J) array
        Entry [t, i, j] is the probability of going from mode i to mode j; rows sum to 1.

    Returns
    -------
    Mixture
        Mixed means and covariances; `mode_probability` (T, J) is the predicted one.

    References
    ----------
    [ZHUK09] eq. 18 to 20.

    """
    probability = np.maximum(mixture.mode_probability, _LEAST_WEIGHT)
    joint = probability[:, :, None] * transition_probability  # (T, i, j)
    predicted = over_modes(np.add, joint)
    weight = np.swapaxes(joint / np.maximum(predicted, _LEAST_WEIGHT)[:, None], 1, 2)  # (T, j, i)
    offset = mixture.mean - mixture.mean[:, :1]  # small numbers: no cancellation below
    mean = np.einsum('tji,tin->tjn', weight, offset)
    square = mixture.covariance + np.einsum('tjn,tjm->tjnm', offset, offset)
    covariance = np.einsum('tji,tinm->tjnm', weight, square)
    covariance -= np.einsum('tjn,tjm->tjnm', mean, mean)
    return Mixture(mixture.mean[:, :1] + mean, covariance, predicted, mixture.memory)
