# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are sectors put together to full turns?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_tracker.gaps import is_missing, STAMPS, usual_step
from tracking_core.batches import Plots
from tracking_core.linalg import TURN
from tracking_core.rows import concatenate


class Turns:
    """
    Collects sectors until they are a turn.

    Parameters
    ----------
    period : float
        Of a turn [s], 0: as the antenna is found to turn.
    most : int
        Plots of a turn; with stamps that hardly go on it would never end.

    """

    def __init__(self, period: float, most: int) -> None:
        self._period, self._most = period, most
        self._plots: Plots | None = None  # of the sectors so far
        self._stamps = np.zeros(0)  # of the last sectors [s]
        self.part = 0.0  # how long that was which was returned last [s], 0: a turn

    def add(self, sector: Plots, rotation_rate: float) -> Plots | None:
        """
        Return the turn that this sector completes, with the stamp of its first, or None.

        Where sectors are missing before this one, or there are too many plots, those so far are
        all that comes of their turn, or the first part of it.
        """
        period = self._period or (TURN / abs(rotation_rate) if rotation_rate else 0.0)
        self._stamps = np.append(self._stamps, sector.stamp)[-STAMPS:]
        ahead = float(np.diff(self._stamps[-2:]).sum())  # when this sector will be over
        is_late, before = is_missing(self._stamps, period), self._plots
        if is_late:
            ahead = usual_step(self._stamps, period)
        if before is not None and (is_late or len(before) + len(sector) > self._most):
            self._plots = sector
            self.part = float(self._stamps[-2]) + ahead - before.stamp
            return before
        joined = sector if self._plots is None else concatenate(self._plots, sector)
        first = sector.stamp if self._plots is None else self._plots.stamp
        turn = replace(joined, stamp=first)
        is_whole = sector.stamp + ahead - first >= period * (1.0 - 1e-3)
        self._plots, self.part = None if is_whole else turn, 0.0
        return turn if is_whole else None
