# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How long is it from one look at a place to the next?

A rotating antenna says so. Without one nobody does: a scan ends with its last plot, wherever in
the cycle that was, or with its stamp where it has none. What is usual of the last scans is taken.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Coverage, Floats
from tracking_core.linalg import TURN

_MOST = 9  # steps that tell what is usual: few, so that another cycle is soon the usual one
_UNKNOWN = 1.0  # before there were two scans [s]


def add_step(steps: Floats, coverage: Coverage, last: float) -> Floats:
    """
    Return the last steps from scan to scan with this one, if it was one.

    Parameters
    ----------
    steps : (N,) array
        Of the scans before [s].
    coverage : Coverage
        Of this scan, which cannot have begun before the look was over that ended at `last`.
    last : float
        End of the last scan, -inf: there was none [s].

    """
    lasted, since = coverage.end_time - coverage.start_time, coverage.end_time - last
    step = max(lasted, since if since < np.inf else 0.0)
    return np.append(steps, step)[-_MOST:] if step > 0.0 else steps


def interval_of_looks(steps: Floats, coverage: Coverage) -> float:
    """Return the time between two looks at the same place [s], after the last steps (N,) [s]."""
    rate = abs(coverage.rotation_rate)
    if rate:
        return TURN / rate
    return float(np.sort(steps)[len(steps) // 2]) if len(steps) else _UNKNOWN
