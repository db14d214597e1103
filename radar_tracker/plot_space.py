# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How much plot space, in which false plots are even, is in a unit of the space of places?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Bools, Floats


def space_per_metre(offset: Floats, is_polar: bool) -> Floats:
    """Return plot space per m^d (T,) at places (T, d) seen from the sensor."""
    if not is_polar:
        return np.ones(len(offset))
    ground = _ground(offset)
    if offset.shape[1] == 2:
        return np.asarray(1.0 / ground)
    return np.asarray(1.0 / (np.hypot(ground, offset[:, 2]) * ground))  # 1/(r^2 cos elevation)


def of_plots(offset: Floats, unknown: Bools, is_polar: bool, span: float) -> Floats:
    """
    Return plot space per m^d (M,) at plots (M, d), per m^2 at those of `unknown` height (M,).

    Over a place on the ground lies all that is within the elevations `span` [rad].
    """
    space = space_per_metre(offset, is_polar)
    ground = _ground(offset)
    return np.where(unknown, span / ground if is_polar else span * ground, space)


def _ground(offset: Floats) -> Floats:
    return np.maximum(np.hypot(offset[:, 0], offset[:, 1]), 1.0)
