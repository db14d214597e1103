# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which pairs of plots are followed though they prove little? Dense clutter has no others."""

from __future__ import annotations

import math

import numpy as np

from tracking_core.batches import Coverage, Floats, Ints
from tracking_core.density import Density
from tracking_core.linalg import TURN

_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)  # part of a whole that meets no place twice


def share_of_faint(faint_starts: int, coverage: Coverage, density: Density) -> int:
    """
    Return how many of the faint starts of a look this scan may have.

    They are marks along the turn, with as much clutter between any two, and a sector has those
    that it sweeps over: so a turn has them all, however many sectors it is cut into. In each turn
    they lie elsewhere, so that no sector goes without for ever.
    """
    if coverage.rotation_rate == 0.0:
        return faint_starts
    turn_time = 2.0 ** round(-math.log2(abs(coverage.rotation_rate) / TURN))  # roughly
    turn = math.floor(coverage.start_time / turn_time)
    begin, end = (
        math.copysign(1.0, coverage.sweep) * density.turns_of_clutter(azimuth)
        for azimuth in (coverage.start_azimuth, coverage.start_azimuth + coverage.sweep)
    )
    before = faint_starts * begin + _GOLDEN * turn
    return math.floor(before + faint_starts * min(end - begin, 1.0)) - math.floor(before)


def worth_a_track(existence: Floats, least: float, leniency: float, most: int) -> Ints:
    """Return the pairs (K,) that are likely enough, and the likeliest of the faint ones."""
    keep = existence >= least
    faint = ((existence >= least / leniency) & ~keep).nonzero()[0]
    keep[faint[np.argsort(-existence[faint], kind='stable')[:most]]] = True
    return keep.nonzero()[0]
