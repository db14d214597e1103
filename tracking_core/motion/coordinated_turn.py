# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A turn of known rate at even speed: linear, because the rate belongs to the mode."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_core.motion.constant_velocity import ConstantVelocity, white_acceleration_noise


@dataclass(frozen=True)
class CoordinatedTurn:
    """State (x, vx, y, vy); the velocity turns by `turn_rate` [rad/s, anticlockwise]."""

    turn_rate: float  # [rad/s]
    acceleration_sd: float  # [m/s^2]
    axes: int = 2

    def __post_init__(self) -> None:
        if self.axes != 2:
            raise ValueError(f'CoordinatedTurn.axes must be 2, got {self.axes}')

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, 4, 4) over the times dt (T,) [s]."""
        if self.turn_rate == 0.0:
            return ConstantVelocity(self.acceleration_sd).transition(dt)
        angle = self.turn_rate * dt
        along, across = np.sin(angle) / self.turn_rate, (1.0 - np.cos(angle)) / self.turn_rate
        matrix = np.zeros((len(dt), 4, 4), order='F')
        matrix[:, 0, 0] = matrix[:, 2, 2] = 1.0
        matrix[:, 0, 1] = matrix[:, 2, 3] = along
        matrix[:, 2, 1], matrix[:, 0, 3] = across, -across
        matrix[:, 1, 1] = matrix[:, 3, 3] = np.cos(angle)
        matrix[:, 3, 1], matrix[:, 1, 3] = np.sin(angle), -np.sin(angle)
        return matrix

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, 4, 4) over the times dt (T,) [s]."""
        return white_acceleration_noise(dt, self.acceleration_sd, 2)
