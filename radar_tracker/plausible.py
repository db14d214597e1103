# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What can parameters not mean, as near as the radar sees?

A default that fits a radar of 100 km leaves one of 50 m without a track: all pairs of plots are
one contact's, and none is surely so.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Coverage, Floats
from tracking_core.interval import interval_of_looks
from tracking_core.lifecycle_config import InitiationConfig

_COARSEST = 0.03  # of the farthest plot's distance; no radar's range noise is larger
_FEWEST = 6.0  # looks that a contact stays in what the radar sees; else nobody confirms it
_ENOUGH = 9.5  # looks that tell how far the radar sees
_SLOWEST = 0.1  # m/s, that any radar can track


def coarsest(farthest: float) -> float:
    """Return the largest noise in range or position [m]; `farthest` of the plots [m], 0: none."""
    return _COARSEST * farthest or np.inf


def fastest(told: InitiationConfig, farthest: float, steps: Floats, coverage: Coverage) -> float:
    """
    Return the speed of the fastest contact that can be tracked [m/s], as told or less.

    Parameters
    ----------
    told : InitiationConfig
        Has the speed that is told.
    farthest : float
        Of the plots [m], 0: none came.
    steps : (N,) array
        From scan to scan [s], the last ones.
    coverage : Coverage
        Of the last scan.

    """
    interval = interval_of_looks(steps, coverage)
    if farthest == 0.0 or steps.sum() < _ENOUGH * interval:
        return told.speed_max
    return min(told.speed_max, max(2.0 * farthest / (_FEWEST * interval), _SLOWEST))
