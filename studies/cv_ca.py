# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What would a Kalman filter of two motions do on K-0? Constant velocity or acceleration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.estimators import MarkovJump
from tracking_core.mode_chain import ModeChain

_ACCELERATION = 10.0  # sd of an acceleration that begins [m/s^2]


@dataclass(frozen=True)
class Steady:
    """State (x, v, a) of one axis at constant velocity; a is what an acceleration would be."""

    acceleration_sd: float
    axes: int = 1

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, 3, 3): the acceleration is not used and forgotten."""
        F = np.zeros((len(dt), 3, 3))
        F[:, [0, 1], [0, 1]], F[:, 0, 1] = 1.0, dt
        return F

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, 3, 3); the acceleration is drawn anew."""
        G = self.acceleration_sd * np.stack([0.5 * dt**2, dt, np.zeros(len(dt))], axis=1)
        Q = G[:, :, None] * G[:, None]
        Q[:, 2, 2] = _ACCELERATION**2
        return Q


@dataclass(frozen=True)
class Accelerated:
    """State (x, v, a) of one axis; the acceleration stays, up to a little noise."""

    change_sd: float  # of the acceleration from look to look [m/s^2]
    axes: int = 1

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, 3, 3)."""
        F = np.tile(np.eye(3), (len(dt), 1, 1))
        F[:, 0, 1] = F[:, 1, 2] = dt
        F[:, 0, 2] = 0.5 * dt**2
        return F

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, 3, 3)."""
        G = self.change_sd * np.stack([0.5 * dt**2, dt, np.ones(len(dt))], axis=1)
        return np.asarray(G[:, :, None] * G[:, None])


@dataclass(frozen=True)
class CvCa:
    """`MarkovJump` of both motions, started from position and velocity."""

    filter: MarkovJump
    axes: int = 1

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, 2) and covariances (T, 2, 2)."""
        T = len(mean)
        P = np.zeros((T, 3, 3))
        P[:, :2, :2], P[:, 2, 2] = covariance, _ACCELERATION**2
        return self.filter.start(np.concatenate([mean, np.zeros((T, 1))], axis=1), P)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Mix the modes and move them."""
        return self.filter.predict(mixture, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with every mode."""
        return self.filter.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Update modes and mode probabilities."""
        return self.filter.update(mixture, track, innovations, association)


def cv_ca() -> CvCa:
    """Return the filter of the table: 9 of 10 looks in the same mode."""
    motions = (Steady(0.3), Accelerated(0.5))
    return CvCa(MarkovJump(motions, ModeChain.staying(0.9, 5.0), (0.9, 0.1)))
