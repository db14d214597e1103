# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does the sensor's platform stand and move at the times that were asked for?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats


@dataclass(frozen=True)
class PlatformPose:
    """Platform at the times asked for."""

    position: Floats  # (M, 3) tracking frame [m]
    orientation: Floats  # (M, 4) quaternion x y z w, platform axes to tracking axes
    velocity: Floats  # (M, 3) tracking frame [m/s]
    position_covariance: Floats  # (M, 3, 3) [m^2]
    yaw_variance: Floats  # (M,) [rad^2]
    turn_rate: Floats  # (M, 3) about the platform's axes [rad/s]

    @property
    def yaw(self) -> Floats:
        """Heading (M,), anticlockwise from x [rad]."""
        x, y, z, w = self.orientation.T
        return np.asarray(np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))

    @property
    def rotation(self) -> Floats:
        """Matrices (M, 3, 3) from platform axes to tracking axes."""
        x, y, z, w = self.orientation.T
        matrix = np.empty((len(x), 3, 3))
        matrix[:, 0, 0], matrix[:, 1, 1] = 1.0 - 2.0 * (y * y + z * z), 1.0 - 2.0 * (x * x + z * z)
        matrix[:, 2, 2] = 1.0 - 2.0 * (x * x + y * y)
        matrix[:, 0, 1], matrix[:, 1, 0] = 2.0 * (x * y - z * w), 2.0 * (x * y + z * w)
        matrix[:, 0, 2], matrix[:, 2, 0] = 2.0 * (x * z + y * w), 2.0 * (x * z - y * w)
        matrix[:, 1, 2], matrix[:, 2, 1] = 2.0 * (y * z - x * w), 2.0 * (y * z + x * w)
        return matrix
