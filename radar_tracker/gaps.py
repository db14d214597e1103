# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Is a sector missing between two others? Their stamps tell.

Sectors may be of any lengths, and some radars send none where they see nothing. So a long step is
a gap only if there was a message from there a turn ago.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats

STAMPS = 400  # worth remembering; of more in two turns a gap is not noticed
_MOST = 0.8  # of the time lies in steps that are usual
_LONG = 1.5  # usual steps
_APART = 0.5  # usual steps between the stamps about a gap and those that it lacks
_LONGEST = 0.75  # of a turn without a message: then the antenna was not followed


def usual_step(stamps: Floats, period: float) -> float:
    """Return how far stamps (N,) in order are usually apart at most, 0 if nobody knows [s]."""
    steps = np.sort(np.diff(stamps))
    steps = steps[steps < _LONGEST * period]
    total = np.cumsum(steps)
    return float(steps[np.searchsorted(total, _MOST * total[-1])]) if len(steps) else 0.0


def is_missing(stamps: Floats, period: float) -> bool:
    """
    Return whether a sector is missing before the last one.

    Parameters
    ----------
    stamps : (N,) array
        Of sectors, in order [s].
    period : float
        Of a turn [s], 0: not known.

    """
    if len(stamps) < 2 or not period:
        return False
    before, now = stamps[-2:]
    if now - before >= _LONGEST * period:
        return True
    usual = usual_step(stamps[:-1], period)
    if not usual or now - before <= _LONG * usual:
        return False
    first, last = np.array([before, now]) - period + _APART * usual * np.array([1.0, -1.0])
    return bool(((stamps > first) & (stamps < last)).any())
