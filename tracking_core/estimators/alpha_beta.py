# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The plain alpha-beta filter: the same gain at every look."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.alpha_beta import GainFilter
from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture


@dataclass(frozen=True)
class AlphaBeta:
    """
    One mode, gains alpha and beta = alpha^2 / (2 - alpha).

    References
    ----------
    [BENEDICT62], [KHACH02] eq. 1 and 2.

    """

    alpha: float
    axes: int
    covariance: str = 'steady_state'

    @cached_property
    def _gains(self) -> GainFilter:
        return GainFilter((self.alpha,), self.axes, self.covariance)

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, n) and covariances (T, n, n)."""
        return self._gains.start(mean, covariance)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move straight on over the times dt (T,) [s]."""
        return self._gains.predict(mixture, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with the prediction."""
        return self._gains.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Correct by the fixed gain."""
        alpha = np.full((len(mixture.mean), 1), self.alpha)
        after = self._gains.update(mixture, track, innovations, association, alpha)
        return self._gains.admit_lag(after, mixture, track, innovations, association, alpha)
