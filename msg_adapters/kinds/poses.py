# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How poses become columns: positions for a radar, directions for a sonar."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.position_noise import covariance_columns
from msg_adapters.table import Columns

YAW = 35  # place of the yaw variance in a row-major 6 x 6 covariance


def positions(points: list[Any]) -> Columns:
    """Return x, y and z [m], each (M,)."""
    rows = [[point.x, point.y, point.z] for point in points]
    return dict(zip('xyz', np.array(rows, np.float64).reshape(-1, 3).T, strict=True))


def pose_array(msg: Any) -> Columns:
    """Return the positions of a geometry_msgs/PoseArray; orientations say nothing of a plot."""
    return positions([pose.position for pose in msg.poses])


def pose_with_covariance(msg: Any) -> Columns:
    """
    Return one row from a geometry_msgs/PoseWithCovarianceStamped.

    For a radar the position [m] with its covariance; for a sonar the yaw is the direction of
    arrival [rad], with its standard deviation where the covariance tells one.
    """
    pose, q = msg.pose.pose, msg.pose.pose.orientation
    x, y, z, w = np.array([q.x, q.y, q.z, q.w])  # of numpy: too large is infinite, no exception
    with np.errstate(over='ignore', invalid='ignore'):
        length = x**2 + y**2 + z**2 + w**2
        yaw = np.arctan2(2.0 * (w * z + x * y), length - 2.0 * (y**2 + z**2))
    variance = msg.pose.covariance[YAW]
    return {
        **positions([pose.position]),
        **covariance_columns([msg.pose.covariance]),
        'bearing': np.array([yaw if length else np.nan]),
        'bearing_sd': np.array([np.sqrt(variance) if variance > 0.0 else np.nan]),
    }
