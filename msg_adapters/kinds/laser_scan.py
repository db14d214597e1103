# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the echoes of a sensor_msgs/LaserScan become columns."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.table import Columns


def laser_scan(msg: Any) -> Columns:
    """
    Return range [m], azimuth [rad] and time after the stamp [s] of every echo, each (M,).

    A ray without an echo (beyond the limits of the message, or no number; REP-117) is no row.

    Raises
    ------
    BadMessage
        For limits that no echo can keep.

    """
    ranges = np.asarray(msg.ranges, np.float64)
    if len(ranges) and not msg.range_min < msg.range_max:
        told = f'range_min = {msg.range_min:g}, range_max = {msg.range_max:g}'
        raise BadMessage('bad limits', f'no echo can be within {told}')
    is_echo = np.isfinite(ranges) & (ranges >= msg.range_min) & (ranges <= msg.range_max)
    (ray,) = np.nonzero(is_echo)
    return {
        'range': ranges[ray],
        'azimuth': msg.angle_min + ray * msg.angle_increment,
        'time': ray * float(msg.time_increment),
    }
