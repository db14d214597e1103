# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is compared, in one form for every sensor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from msg_adapters.table import Columns
from tracking_core.batches import Floats
from tracking_tools.scoring import TrackRows, Truth


@dataclass(frozen=True)
class Recorded:
    """Confirmed tracks of one recording and what was really there."""

    sensor: str  # 'radar' or 'sonar'
    rows: TrackRows  # sonar: one coordinate, the bearing
    table: Columns  # all columns of these rows
    truth: Truth
    starts: Floats  # (K + 1,) when each scan begins, and when the last one ends [s]
    has_velocity: bool  # whether the truth tells velocities
    plot_size: int  # coordinates of a plot, which its NIS is of
    ranges: Columns | None = None  # sonar: id, time, range [m] of the truth

    @property
    def scans(self) -> int:
        """How many track tables there are."""
        return len(self.starts) - 1

    @property
    def manoeuvre_probability(self) -> Floats:
        """Of each row (N,); NaN where the table does not tell."""
        told = self.table.get('manoeuvre_probability', np.full(len(self.rows), np.nan))
        return np.asarray(told, np.float64)

    @property
    def duration(self) -> float:
        """How long the tracks were recorded [s]."""
        return float(self.starts[-1] - self.starts[0])
