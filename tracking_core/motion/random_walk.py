# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A bearing that goes on at its rate, while both drift a little."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats


@dataclass(frozen=True)
class RandomWalk:
    """
    State (position, velocity) of one axis; both drift as random walks in continuous time.

    References
    ----------
    [VORONINA19] eq. 6 to 9, whose noise is per cycle; here it is right for every time step.

    """

    position_noise: float  # [rad/sqrt(s)]
    velocity_noise: float  # [rad/s/sqrt(s)]
    axes: int = 1

    def __post_init__(self) -> None:
        if self.axes != 1:
            raise ValueError(f'RandomWalk.axes must be 1, got {self.axes}')

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, 2, 2) over the times dt (T,) [s]."""
        matrix = np.tile(np.eye(2), (len(dt), 1, 1))
        matrix[:, 0, 1] = dt
        return matrix

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, 2, 2) over the times dt (T,) [s]."""
        dt = np.abs(dt)
        q = self.velocity_noise**2
        matrix = np.empty((len(dt), 2, 2))
        matrix[:, 0, 0] = self.position_noise**2 * dt + q * dt**3 / 3.0
        matrix[:, 0, 1] = matrix[:, 1, 0] = 0.5 * q * dt**2
        matrix[:, 1, 1] = q * dt
        return matrix
