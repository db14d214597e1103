# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is there really an own ship, where none has been so far? One message does not make a ship."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

AGREEING = 3  # messages in a row that make it believed
SLOWEST = 10.0  # s between two of them


@dataclass
class Newcomer:
    """Count what agrees: messages in one frame, each a little later than the one before."""

    _frame: str = ''
    _time: float = -np.inf
    _count: int = 0

    def is_believed(self, frame: str, time: float) -> bool:
        """Return whether this odometry, of this time [s], is one of several that agree."""
        agrees = frame == self._frame and 0.0 < time - self._time <= SLOWEST
        self._count = self._count + 1 if agrees else 1
        self._frame, self._time = frame, time
        return self._count >= AGREEING
