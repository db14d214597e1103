# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How near each other do contacts give one plot?"""

from __future__ import annotations

import numpy as np

from radar_tracker.conversion import linearised
from radar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Floats

_WIDEST = 1.0  # rad, that a contact seems, however near


def limits(config: SensorConfig, polar: Floats) -> Floats:
    """
    Return how near contacts give one plot, at these places (P, d), on each axis (P, d).

    Range [m], azimuth and elevation [rad]: the beam is as high as it is wide. Plots in a box of
    which the diagonal is the size of a contact are made one (`several_plots`): so the side of it
    is a limit, too.
    """
    side = config.contact_size / np.sqrt(2.0)
    across = np.minimum(side / np.maximum(polar[:, 0], 1.0), _WIDEST)
    across = np.maximum(across, config.azimuth_resolution)
    along = np.full(len(polar), max(config.range_resolution, side))
    return np.stack([along, across, across][: polar.shape[1]], axis=1)


def reach(config: SensorConfig, polar: Floats) -> Floats:
    """Return half size (T, d) [m] of the box of all that may be one plot with a contact there."""
    limit = limits(config, polar)
    sides = [linearised(polar, limit * axis)[1] for axis in np.eye(polar.shape[1])]
    straight = np.sum([np.sqrt(np.einsum('tdd->td', side)) for side in sides], axis=0)
    bend = (1.0 - np.cos(limit[:, 1:2])) * polar[:, :1]  # a cell is an arc
    return np.asarray(straight + bend)
