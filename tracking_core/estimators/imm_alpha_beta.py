# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Interacting alpha-beta filters: one fixed gain per mode, mixed as the modes change."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tracking_core.alpha_beta import GainFilter
from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.estimators.markov_jump import mix


@dataclass(frozen=True)
class ImmAlphaBeta:
    """
    All modes move straight on; they differ in how far they trust the plots.

    Mode probabilities change from look to look, whatever time lies between, as do the gains.

    References
    ----------
    [BAKULEV] eq. 8 to 16. `recursion` mixes covariances with the spread of means; with
    `steady_state` each mode keeps its own, so that S = R / (1 - alpha) unless the busiest lags.

    """

    alpha: tuple[float, ...]  # of each mode, the quiet mode first
    axes: int
    covariance: str = 'steady_state'
    stay_probability: float = 0.9  # from one look to the next

    def __post_init__(self) -> None:
        if not 0.0 < self.stay_probability < 1.0:
            raise ValueError(f'stay_probability must be in (0, 1), got {self.stay_probability}')

    @cached_property
    def _gains(self) -> GainFilter:
        return GainFilter(self.alpha, self.axes, self.covariance)

    @cached_property
    def transition_probability(self) -> Floats:
        """Pi (J, J) from look to look; entry [i, j] is from i to j."""
        J = len(self.alpha)
        if J == 1:
            return np.ones((1, 1))
        away = (1.0 - self.stay_probability) / (J - 1)
        return np.full((J, J), away) + (self.stay_probability - away) * np.eye(J)

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, n) and covariances (T, n, n), equal in all modes."""
        return self._gains.start(mean, covariance)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Mix the modes (eq. 8 to 10) and move them over the times dt (T,) [s]."""
        mixed = mix(mixture, self.transition_probability[None])
        if self.covariance == 'steady_state':
            mixed = replace(mixed, covariance=mixture.covariance)
        return self._gains.predict(mixed, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with every mode."""
        return self._gains.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Correct every mode by its gain, and the mode probabilities (eq. 11 to 14)."""
        alpha = np.broadcast_to(np.array(self.alpha), mixture.mode_probability.shape)
        after = self._gains.update(mixture, track, innovations, association, alpha)
        return self._gains.admit_lag(after, mixture, track, innovations, association, alpha)
