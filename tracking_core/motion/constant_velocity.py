# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Straight and even motion, disturbed by an acceleration that is constant between two looks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats


@dataclass(frozen=True)
class ConstantVelocity:
    """
    State (position, velocity) on each axis; piecewise constant white acceleration.

    A piece is the time between two looks, whatever it is. So one step of 2 T is noisier than two
    of T: a message that was lost leaves a wider gate than one that was empty.

    References
    ----------
    [ZHUK09] eq. 1 to 3: F = [1 T; 0 1], G = (T^2/2, T) times the acceleration.

    """

    acceleration_sd: float  # [m/s^2]
    axes: int = 2

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, n, n) over the times dt (T,) [s]."""
        matrix = np.zeros((len(dt), 2 * self.axes, 2 * self.axes), order='F')
        np.einsum('tnn->tn', matrix)[...] = 1.0
        for place in range(0, 2 * self.axes, 2):
            matrix[:, place, place + 1] = dt
        return matrix

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q = G G^T (T, n, n) over the times dt (T,) [s]."""
        return white_acceleration_noise(dt, self.acceleration_sd, self.axes)


def white_acceleration_noise(dt: Floats, acceleration_sd: float, axes: int) -> Floats:
    """Return G G^T (T, n, n), G = acceleration_sd (dt^2/2, dt) on each axis, dt (T,) [s]."""
    G = np.empty((len(dt), 2), order='F')
    G[:, 0], G[:, 1] = acceleration_sd * 0.5 * dt * dt, acceleration_sd * dt
    on_axis = G[:, :, None] * G[:, None, :]
    matrix = np.zeros((len(dt), 2 * axes, 2 * axes), order='F')
    for place in range(0, 2 * axes, 2):
        matrix[:, place : place + 2, place : place + 2] = on_axis
    return matrix
