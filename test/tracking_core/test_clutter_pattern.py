# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The clutter at a place is that of the squares of cells around it."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.batches import Floats
from tracking_core.clutter_map import ClutterMap, RING_EDGES, RINGS, SPOKES
from tracking_core.clutter_pattern import Pattern
from tracking_core.space import ANGLES, POINTS, Space

HERE = (0.0, 0.0, 0.0)


def middles(space: Space, first: int, rings: int) -> Floats:
    """Return the middle (A * R, d) of every cell, spoke by spoke."""
    azimuth = (np.arange(SPOKES) + 0.5) * 2.0 * np.pi / SPOKES
    if space is ANGLES:
        return azimuth[:, None]
    distance = 0.5 * (RING_EDGES[:-1] + RING_EDGES[1:])[first : first + rings]
    azimuth, distance = (grid.ravel() for grid in np.meshgrid(azimuth, distance, indexing='ij'))
    return np.column_stack([distance * np.cos(azimuth), distance * np.sin(azimuth)])


def relief_by_loops(count: Floats, space: Floats, mean: float) -> Floats:
    """Return the relief (A, R) from squares of 19, 7 and 3 cells a side, without the middle."""
    A, R = count.shape
    relief = np.empty((A, R))
    for spoke in range(A):
        for ring in range(R):
            density = mean
            for half in (9, 3, 1):
                spokes = np.arange(spoke - half, spoke + half + 1) % A
                rings = np.arange(max(ring - half, 0), min(ring + half + 1, R))
                square = np.ix_(spokes, rings)
                plots = count[square].sum() - count[spoke, ring]
                around = space[square].sum() - space[spoke, ring]
                density = (4.0 + plots) / (4.0 / density + around)
            relief[spoke, ring] = density / mean
    return relief


@pytest.mark.parametrize(('space', 'first', 'rings'), [(POINTS, 20, 30), (ANGLES, 0, 1)])
def test_relief_is_that_of_a_loop_over_all_cells(space: Space, first: int, rings: int) -> None:
    """Cell by cell, over the north and at the nearest and the farthest ring as anywhere."""
    rng = np.random.default_rng(8)
    all_rings = RINGS if space is POINTS else 1
    count = rng.poisson(2.0, (SPOKES, all_rings)).astype(float)
    looks, depth = rng.uniform(1.0, 9.0, count.shape), rng.uniform(10.0, 90.0, rings)
    known, mean = ClutterMap(count, looks), 0.01
    found = Pattern(known, mean, space, HERE, first, depth).relief(middles(space, first, rings))
    seen = slice(first, first + rings)
    wanted = relief_by_loops(count[:, seen], looks[:, seen] * depth, mean)
    assert_allclose(found.reshape(wanted.shape), wanted, rtol=1e-9)
