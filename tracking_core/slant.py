# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Where over the ground is a plot that tells its slant range, but no height?

By itself it lies as far out as its range, an aircraft at 10 km height in 20 km range by 2.7 km too
far. The track that it may belong to knows the height.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints, Scan


def over_ground(position: Floats, plot: Ints, height: Floats, scan: Scan) -> Floats:
    """
    Return places (P, d) of plots that are brought in to where they are at these heights.

    Parameters
    ----------
    position : (P, d) array
        Of the plots; those without height stand at their slant range.
    plot : (P,) array
        Their rows in the scan.
    height : (P,) array
        Of the tracks that they may belong to [m].
    scan : Scan
        M plots.

    """
    unknown = _without_height(position, scan).nonzero()[0]
    if len(unknown) == 0:
        return position
    origin = scan.sensor_position[plot[unknown]]
    way = position[unknown, :2] - origin[:, :2]
    steep = (height[unknown] - origin[:, 2]) / np.maximum(np.hypot(way[:, 0], way[:, 1]), 1.0)
    nearer = position.copy('K')
    nearer[unknown, :2] = origin[:, :2] + way * np.sqrt(np.maximum(1.0 - steep**2, 0.0))[:, None]
    return nearer


def farther_out(centre: Floats, scan: Scan) -> Floats:
    """Return by how much plots without height may seem farther out than tracks (T, d) are [m]."""
    if not _without_height(scan.position, scan).any():
        return np.zeros(len(centre))
    offset = centre - np.array(scan.coverage.sensor_position)
    ground = np.hypot(offset[:, 0], offset[:, 1])
    return np.asarray(np.hypot(ground, offset[:, 2]) - ground)


def _without_height(position: Floats, scan: Scan) -> Floats:
    return np.isnan(position[:, 2]) if scan.is_slant else np.zeros(len(position), bool)
