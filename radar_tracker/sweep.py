# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where does the antenna point during a message?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Gaps, NO_GAPS, NO_SWING

EVEN = 0.1  # s, in which a platform turns evenly


@dataclass(frozen=True)
class Sweep:
    """What one message swept: the antenna turned by `angle` from `start_azimuth`."""

    start_time: float  # [s]
    end_time: float  # [s]
    start_azimuth: float = 0.0  # sensor axes [rad]
    angle: float = 0.0  # signed [rad]; 0: a look everywhere at once
    gaps: Gaps = NO_GAPS  # before it
    unevenness: float = 0.0  # by how much the antenna may point elsewhere [rad]

    @property
    def is_long(self) -> bool:
        """Whether a platform may swing in it."""
        return self.end_time - self.start_time > EVEN

    @property
    def ends(self) -> Floats:
        """Return start and end (2,) [s]."""
        return np.array([self.start_time, self.end_time])

    @property
    def moments(self) -> Floats:
        """Return times (K,) in even steps from start to end [s]."""
        if not self.is_long:
            return self.ends
        return np.linspace(self.start_time, self.end_time, len(NO_SWING))


@dataclass(frozen=True)
class Beam:
    """Where the antenna points, where that is known otherwise than from the plots' times."""

    time: float  # [s]
    azimuth: float  # at this time, sensor axes [rad]
    rate: float  # anticlockwise positive [rad/s]
    end_time: float  # of the sector [s]
