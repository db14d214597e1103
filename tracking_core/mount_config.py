# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where does a sensor sit on its platform? The parameters that radar and sonar share."""

from __future__ import annotations

from typing import Any

from tracking_core.config import parameter

FARTHEST = 1e7  # m, of a sensor from the origin of its platform or of the tracking frame
MOST_YAW = 6.3  # rad, a little more than a full turn


def mount_offset(way: str) -> Any:
    """Return the dataclass field that says how far a sensor is from the origin, in one way."""
    return parameter(0.0, unit='m', doc=f'{way} the platform origin', low=-FARTHEST, high=FARTHEST)


def mount_yaw() -> Any:
    """Return the dataclass field that says how a sensor is turned."""
    return parameter(
        0.0, unit='rad', doc='anticlockwise from the platform x axis', low=-MOST_YAW, high=MOST_YAW
    )
