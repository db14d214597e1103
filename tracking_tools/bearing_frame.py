# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which bearings and times a picture shows; bearings are shown as a navigator counts them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_core.linalg import nearest_turn
from tracking_tools.bearing_scene import BearingScene

FULL = 300.0  # degrees; tracks all around are shown all around
MARGIN = 8.0  # beside all tracks [deg]


@dataclass(frozen=True)
class Frame:
    """What a panel shows: bearings [deg] and times [s]."""

    left: float
    right: float
    start: float
    end: float

    def degrees(self, bearing: Floats) -> Floats:
        """Return bearings [rad] as a navigator counts them, in the turn that is shown."""
        middle = np.radians(0.5 * (self.left + self.right))
        return to_degrees(bearing, middle)


def frame_of_tracks(scene: BearingScene) -> Frame:
    """Return the frame that holds all tracks, and all marks in time; at least a second."""
    parts = [rows['time'] for rows in (scene.marks, scene.tracks) if len(rows.get('time', ()))]
    start = float(min((part.min() for part in parts), default=0.0))
    span = (start, max(float(max((part.max() for part in parts), default=0.0)), start + 1.0))
    bearing = np.asarray(scene.tracks.get('bearing', ()), np.float64)
    around = Frame(0.0, 360.0, *span)
    if not len(bearing):
        return around
    middle = float(np.angle(np.exp(1j * (np.pi / 2.0 - bearing)).mean()))
    degrees = to_degrees(bearing, middle)
    if np.ptp(degrees) > FULL:
        return around
    return Frame(float(degrees.min()) - MARGIN, float(degrees.max()) + MARGIN, *span)


def to_degrees(bearing: Floats, near: float) -> Floats:
    """Return bearings [rad] clockwise from north [deg], in the turn that is nearest to one."""
    clockwise = np.pi / 2.0 - np.asarray(bearing, np.float64)
    return np.degrees(nearest_turn(clockwise, np.full(clockwise.shape, near)))
