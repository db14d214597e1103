# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where does the antenna point during a message?"""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.batches import Gaps, NO_GAPS


@dataclass(frozen=True)
class Sweep:
    """What one message swept: the antenna turned by `angle` from `start_azimuth`."""

    start_time: float  # [s]
    end_time: float  # [s]
    start_azimuth: float = 0.0  # sensor axes [rad]
    angle: float = 0.0  # signed [rad]; 0: a look everywhere at once
    gaps: Gaps = NO_GAPS  # before it
    unevenness: float = 0.0  # by how much the antenna may point elsewhere [rad]


@dataclass(frozen=True)
class Beam:
    """Where the antenna points, where that is known otherwise than from the plots' times."""

    time: float  # [s]
    azimuth: float  # at this time, sensor axes [rad]
    rate: float  # anticlockwise positive [rad/s]
    end_time: float  # of the sector [s]
