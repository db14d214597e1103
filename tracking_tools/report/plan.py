# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How large is the plan, in which unit is it, and how precise must its places be?"""

from __future__ import annotations

import numpy as np

from msg_adapters.table import Columns
from tracking_core.batches import Floats
from tracking_tools.scene import Scene

KM = 1000.0
FAR = 3.0 * KM  # a plan of less is in metres
SHORT = 0.04  # part of the plan that a fast track goes while it leads ahead
LEADS = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0)  # [s]
FINE = 1e-4  # of the width of the plan that steps may have


def plan_unit(scene: Scene) -> float:
    """Return the unit of the plan [m]: a kilometre, or a metre where all tracks are near."""
    return KM if _width(scene.published) > FAR else 1.0


def lead_time(columns: Columns) -> float:
    """Return for how long ahead tracks are drawn [s]; `columns` as of `track_columns`."""
    speed = np.hypot(columns['vx'], columns['vy'])
    speed = speed[speed > 0.0]
    fast = float(np.quantile(speed, 0.9)) if len(speed) else np.inf
    return max((lead for lead in LEADS if lead * fast < SHORT * _width(columns)), default=LEADS[0])


def _width(table: Columns) -> float:
    """Return how far from each other places are, along x or y."""
    places = np.stack([table['x'], table['y']], axis=1)
    told = places[np.isfinite(places).all(axis=1)]
    return float(np.ptp(told, axis=0).max()) if len(told) else 0.0


def single(values: Floats) -> Floats:
    """Return values in single precision, unless that is too coarse, as for UTM coordinates."""
    told = values[np.isfinite(values)]
    if not len(told):
        return values.astype(np.float32)
    step = np.spacing(np.float32(np.abs(told).max()))
    return values.astype(np.float32 if step <= FINE * np.ptp(told) else np.float64)
