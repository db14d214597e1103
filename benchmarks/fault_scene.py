# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Three contacts on straight courses, seen in real time from the shore or from a ship."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav_msgs.msg import Odometry
import numpy as np

from msg_adapters.message_types import rclpy_types
from msg_adapters.table import Columns
from tracking_core.batches import Floats

SPEED = 15.0  # m/s of own ship, to the north
STRAIGHT = (  # position [m] and velocity [m/s] of each contact
    np.array([[20e3, 5e3], [-15e3, 18e3], [5e3, -25e3]]),
    np.array([[150.0, -80.0], [100.0, 120.0], [-120.0, 90.0]]),
)


@dataclass(frozen=True)
class Scene:
    """Three contacts, and perhaps a ship that carries the radar."""

    begin: float  # stamp [s]
    is_afloat: bool = False

    def contacts(self, stamp: float) -> Floats:
        """Return where the contacts are (3, 2), in the tracking frame [m]."""
        return np.asarray(STRAIGHT[0] + STRAIGHT[1] * (stamp - self.begin))

    def plots(self, stamp: float) -> Columns:
        """Return their plots."""
        rng = np.random.default_rng(int(1e3 * stamp) % 2**32)
        seen = self.contacts(stamp)
        if self.is_afloat:  # x ahead is north
            x, y = (seen - self.own(stamp)).T
            seen = np.stack([y, -x], axis=1)
        distance = np.hypot(*seen.T) + rng.normal(0.0, 20.0, 3)
        azimuth = np.arctan2(seen[:, 1], seen[:, 0]) + rng.normal(0.0, 1e-3, 3)
        return {'range': distance.astype(np.float32), 'azimuth': azimuth.astype(np.float32)}

    def own(self, stamp: float) -> Floats:
        """Return where own ship is (2,) [m]."""
        return np.array([0.0, SPEED * (stamp - self.begin)])

    def odometry(self, stamp: float, leap: float = 0.0) -> Any:
        """Return what own ship says of itself, so far off to the east [m]."""
        msg = Odometry(header=rclpy_types().header(stamp, 'odom'), child_frame_id='base_link')
        x, y = self.own(stamp)
        msg.pose.pose.position.x, msg.pose.pose.position.y = float(x + leap), float(y)
        msg.pose.pose.orientation.z = msg.pose.pose.orientation.w = float(np.sqrt(0.5))
        msg.twist.twist.linear.x = SPEED
        return msg
