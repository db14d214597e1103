# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does the radar's platform not know of itself?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_core.platform_pose import PlatformPose


def platform_noise(pose: PlatformPose, offset: Floats) -> Floats:
    """
    Return what an unsure platform adds to the covariance of plots (M, 3, 3) [m^2].

    Parameters
    ----------
    pose : PlatformPose
        At the times of M plots.
    offset : (M, 3) array
        From the sensor to the plots, tracking axes [m].

    """
    if not pose.yaw_variance.any():
        return pose.position_covariance
    return pose.position_covariance + _swing(offset, pose.yaw_variance)


def _swing(offset: Floats, yaw_variance: Floats) -> Floats:
    """Return what an unsure heading does at these offsets (M, d), (M, d, d)."""
    across = np.zeros_like(offset)
    across[:, 0], across[:, 1] = -offset[:, 1], offset[:, 0]
    return np.asarray(across[:, :, None] * across[:, None, :] * yaw_variance[:, None, None])


@dataclass(frozen=True)
class PlatformDoubt:
    """What a platform does not know of itself, at the worst moment of a message."""

    position_covariance: Floats  # (3, 3) [m^2]
    yaw_variance: float  # [rad^2]

    @staticmethod
    def of(pose: PlatformPose) -> PlatformDoubt | None:
        """Return the doubt in these poses, None if the platform admits none."""
        if not (pose.position_covariance.any() or pose.yaw_variance.any()):
            return None
        worst = int(np.trace(pose.position_covariance, axis1=1, axis2=2).argmax())
        return PlatformDoubt(pose.position_covariance[worst], float(pose.yaw_variance.max()))

    def noise(self, offset: Floats) -> Floats:
        """Return what it adds to the covariance of a plot at these offsets (T, d), (T, d, d)."""
        T, d = offset.shape
        swing = _swing(offset, np.full(T, self.yaw_variance))
        return np.asarray(self.position_covariance[:d, :d] + swing)
