# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do sensors count azimuths, and from what? The parameters that radar and sonar share."""

from __future__ import annotations

from typing import Any

import numpy as np

from tracking_core.batches import Floats
from tracking_core.config import parameter

CONVENTIONS = ('enu', 'compass', 'clockwise')
ANGLE_UNITS = ('rad', 'deg')
REFERENCES = ('frame', 'tracking_frame')


def angle_unit() -> Any:
    """Return the dataclass field that says in which unit messages have their angles."""
    return parameter(
        'rad', unit='', choices=ANGLE_UNITS,
        doc='of all angles in a PointCloud2, their noise too; other types, parameters and tracks '
        'are in rad',
    )  # fmt: skip


def azimuth_convention() -> Any:
    """Return the dataclass field that says how azimuths are counted."""
    return parameter(
        'enu', unit='', choices=CONVENTIONS,
        doc='azimuths anticlockwise from x, clockwise from north (y), or clockwise from x (ahead)',
    )  # fmt: skip


def azimuth_reference() -> Any:
    """Return the dataclass field that says from which axes azimuths are counted."""
    return parameter(
        'frame', unit='', choices=REFERENCES,
        doc="from the axes of the message's frame, or from those of the tracking frame: north-up, "
        "own ship's heading is in them already",
    )  # fmt: skip


def anticlockwise(azimuth: Floats, convention: str) -> Floats:
    """Return azimuths (M,) of a convention anticlockwise from the x axis [rad]."""
    if convention == 'enu':
        return azimuth
    return (np.pi / 2.0 if convention == 'compass' else 0.0) - azimuth
