# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are sectors put together to full turns?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_tracker.rotation import TWO_PI
from tracking_core.batches import Plots
from tracking_core.rows import concatenate


class Turns:
    """
    Collects sectors until they are a turn.

    Parameters
    ----------
    period : float
        Of a turn [s], 0: as the antenna is found to turn.

    """

    def __init__(self, period: float) -> None:
        self._period = period
        self._plots: Plots | None = None  # of the sectors so far
        self._latest = np.nan  # stamp of the last sector [s]

    def add(self, sector: Plots, rotation_rate: float) -> Plots | None:
        """Return the turn that this sector completes, with the stamp of its first, or None."""
        joined = sector if self._plots is None else concatenate(self._plots, sector)
        first = sector.stamp if self._plots is None else self._plots.stamp
        period = self._period or (TWO_PI / abs(rotation_rate) if rotation_rate else 0.0)
        turn = replace(joined, stamp=first)
        ahead = sector.stamp - self._latest  # when this sector will be over
        self._latest = sector.stamp
        is_whole = sector.stamp + np.nan_to_num(ahead) - first >= period * (1.0 - 1e-3)
        self._plots = None if is_whole else turn
        return turn if is_whole else None
