# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is a radar 2-D or 3-D, where no parameter tells? The first height does, if others follow."""

from __future__ import annotations

from radar_tracker.sensor import Radar

FLAT = 100  # plots in a row without a height, as no 3-D radar has them


def flat_after(flat: int, known: Radar, seen: Radar, plots: int) -> int:
    """Return how many plots in a row had no height, after those of which `seen` was told."""
    if seen.dimensions < known.dimensions:
        return flat + plots
    return 0 if known.dimensions == 3 else flat


def is_other(known: Radar, seen: Radar, flat: int) -> bool:
    """
    Return whether the radar has other dimensions than it is known to have.

    A first sector may have no height: one is never too late, unless it was followed by `FLAT`
    plots without. Then it was a fault, and so are all heights after it.
    """
    if seen.dimensions < known.dimensions:
        return flat >= FLAT
    return seen.dimensions > known.dimensions and flat < FLAT
