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

    References
    ----------
    [ZHUK09] eq. 1 to 3: F = [1 T; 0 1], G = (T^2/2, T) times the acceleration.

    """

    acceleration_sd: float  # [m/s^2]
    axes: int = 2

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, n, n) over the times dt (T,) [s]."""
        position, velocity = _places(self.axes)
        matrix = np.zeros((len(dt), 2 * self.axes, 2 * self.axes))
        matrix[:, position, position] = matrix[:, velocity, velocity] = 1.0
        matrix[:, position, velocity] = dt[:, None]
        return matrix

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q = G G^T (T, n, n) over the times dt (T,) [s]."""
        return white_acceleration_noise(dt, self.acceleration_sd, self.axes)


def white_acceleration_noise(dt: Floats, acceleration_sd: float, axes: int) -> Floats:
    """Return G G^T (T, n, n), G = acceleration_sd (dt^2/2, dt) on each axis, dt (T,) [s]."""
    position, velocity = _places(axes)
    to_position = (acceleration_sd * 0.5 * dt * dt)[:, None]
    to_velocity = (acceleration_sd * dt)[:, None]
    matrix = np.zeros((len(dt), 2 * axes, 2 * axes))
    matrix[:, position, position] = to_position**2
    matrix[:, velocity, velocity] = to_velocity**2
    cross = to_position * to_velocity
    matrix[:, position, velocity] = matrix[:, velocity, position] = cross
    return matrix


def _places(axes: int) -> tuple[Floats, Floats]:
    axis = np.arange(axes)
    return 2 * axis, 2 * axis + 1  # type: ignore[return-value]
