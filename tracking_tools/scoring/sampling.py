# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How well is the truth known between its samples?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats
from tracking_core.rows import take
from tracking_tools.scoring.records import Truth
from tracking_tools.scoring.stretches import absences

HALVING = 16.0  # a cubic errs so many times less where samples come twice as often


def error_between_samples(truth: Truth) -> float:
    """
    Return how far the truth is off between its samples, about, root mean square [m or rad].

    Every second sample is left out and compared with what the others make of it. NaN where no
    contact has three samples in a row.
    """
    rows = np.split(np.arange(len(truth.id)), absences(truth.id, truth.time))
    squares = np.concatenate([_squares(take(truth, stretch)) for stretch in rows])
    return float(np.sqrt(squares.mean())) / HALVING if len(squares) else float('nan')


def _squares(stretch: Truth) -> Floats:
    """Return the squared errors (M,) of one stretch of one contact."""
    kept, left = take(stretch, slice(0, None, 2)), take(stretch, slice(1, -1, 2))
    error: Floats = kept.at(left.time).position - left.position
    return np.asarray((error**2).sum(axis=1))
