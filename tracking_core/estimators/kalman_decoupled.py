# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Kalman's filter of a bearing and its rate that forgets how their errors hang together."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.kalman import condition, innovate
from tracking_core.motion import Motion


@dataclass(frozen=True)
class DecoupledKalman:
    """
    One mode, no covariance between bearing and rate from look to look.

    References
    ----------
    [VORONINA19] eq. 6 to 9, the innovation from the extrapolated bearing: with
    M = s_a^2 + s_V^2 dt^2 + q the bearing has M - M^2 / S, S = M + R, after a plot.

    """

    motion: Motion

    @property
    def axes(self) -> int:
        """Number of axes; the state is (position, velocity) on each."""
        return self.motion.axes

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, n) and covariances (T, n, n)."""
        T = len(mean)
        covariance = _diagonal(covariance)
        return Mixture(mean[:, None], covariance[:, None], np.ones((T, 1)), np.zeros((T, 0)))

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Return the plane after the times dt (T,) [s]."""
        F, Q = self.motion.transition(dt)[:, None], self.motion.process_noise(dt)[:, None]
        mean = (F @ mixture.mean[..., None])[..., 0]
        covariance = F @ mixture.covariance @ np.swapaxes(F, -1, -2) + Q
        return replace(mixture, mean=mean, covariance=covariance)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs of the tracks (P,) with the predicted plane."""
        return innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Return the plane after the plots, its covariance cut to the diagonal."""
        after = condition(mixture, track, innovations, association)
        return replace(after, covariance=_diagonal(after.covariance))


def _diagonal(covariance: Floats) -> Floats:
    return covariance * np.eye(covariance.shape[-1])
