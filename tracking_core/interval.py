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

_MOST = 11  # steps that tell what is usual: few, so that another cycle is soon the usual one
_UNKNOWN = 1.0  # before there were two scans [s]
_ROUNDING = 1e-3  # looks


def add_step(steps: Floats, since: float) -> Floats:
    """Return the last steps (N,) from scan to scan with this one, if it was one [s]."""
    return np.concatenate((steps, [since]))[-_MOST:] if 0.0 < since < np.inf else steps


def interval_of_looks(steps: Floats, coverage: Coverage) -> float:
    """Return the time between two looks at the same place [s], after the last steps (N,) [s]."""
    rate = abs(coverage.rotation_rate)
    if rate:
        return TURN / rate
    usual = sorted(steps.tolist())[len(steps) // 2] if len(steps) else 0.0
    return max(usual, coverage.end_time - coverage.start_time) or _UNKNOWN


def time_of_turns(number: int, coverage: Coverage) -> float:
    """
    Return how long after a plot those that follow in so many turns can be [s].

    Half a turn more, for what moves and what waits for open gates; inf if nothing turns.
    """
    rate = abs(coverage.rotation_rate)
    return (number + 0.5) * TURN / rate if rate else np.inf


def time_of_looks(number: int, steps: Floats, coverage: Coverage) -> float:
    """
    Return how long ago plots of the last looks can be [s].

    Without a rotation these looks are the last steps (N,), however long they were; if there were
    fewer, all plots are of the last looks.
    """
    if coverage.rotation_rate:
        return time_of_turns(number, coverage)
    slack = _ROUNDING * interval_of_looks(steps, coverage)
    return float(steps[-number:].sum()) - slack if len(steps) >= number else np.inf
