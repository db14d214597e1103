# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How many times the mean is the clutter at a place?

As many as it is in the cells around the place, not in its own: as in a CFAR detector, a contact
that is not known yet must not take itself for clutter.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Floats, Ints, Scan
from tracking_core.clutter_map import cells, ClutterMap, RING_EDGES, rings_of, SPOKES
from tracking_core.linalg import TURN
from tracking_core.sensing import Sensor
from tracking_core.space import Point, Space

_HALF_SIZES = (0, 9, 3, 1)  # of squares of cells: that of a place, around it from wide to narrow
_PAD = max(_HALF_SIZES)
_PRIOR = 4.0  # plots that the density of the wider square counts for in the narrower one


@dataclass(frozen=True)
class Pattern:
    """A map of clutter as one scan finds it."""

    map: ClutterMap
    mean: float  # density, per unit of plot space
    space: Space
    origin: Point  # the sensor
    first: int  # ring that the sensor sees, of
    depth: Floats  # (R,) rings: plot space of one cell of each

    @staticmethod
    def of(clutter_map: ClutterMap, mean: float, scan: Scan, sensor: Sensor) -> Pattern | None:
        """Return the pattern about where the sensor is in this scan; None: it sees no ring."""
        nearer = sensor.plot_space_volume(RING_EDGES[: rings_of(sensor.space) + 1])
        cell = TURN / (SPOKES * scan.coverage.sector_width)  # its part of a ring
        depth = cell * np.diff(np.minimum(nearer, scan.volume))
        seen = depth.nonzero()[0]
        if len(seen) == 0:
            return None
        first, last = int(seen[0]), int(seen[-1]) + 1
        origin = scan.coverage.sensor_position
        return Pattern(clutter_map, mean, sensor.space, origin, first, depth[first:last])

    def relief(self, position: Floats) -> Floats:
        """
        Return the clutter density at places (K, d) over the mean.

        In each square of cells the count is Poisson; what is expected of it before is a gamma
        distribution about the density of the wider square, as in [KOLACZYK99].
        """
        spoke, ring = np.divmod(cells(self.space, self.origin, position), rings_of(self.space))
        ring = (ring - self.first).clip(0, len(self.depth) - 1)
        plots, space = self._around(spoke, ring)
        density = np.full(len(position), self.mean)
        for size in range(1, len(_HALF_SIZES)):
            density = (_PRIOR + plots[size]) / (_PRIOR / density + space[size])
        return density / self.mean

    def _around(self, spoke: Ints, ring: Ints) -> Floats:
        """Return plots and plot space (2, 4, K) in squares around cells, without these."""
        half, rings = np.array(_HALF_SIZES)[:, None], len(self.depth)
        first, last = spoke + (_PAD - half), spoke + (_PAD + half + 1)
        inner, outer = np.maximum(ring - half, 0), np.minimum(ring + half + 1, rings)
        first, last = first * (rings + 1), last * (rings + 1)
        corners = np.stack([last + outer, last + inner, first + outer, first + inner])
        a, b, c, d = self._sums.take(corners, axis=1).swapaxes(0, 1)
        within = a - b - c + d
        return np.asarray(np.maximum(within - within[:, :1], 0.0))

    @cached_property
    def _sums(self) -> Floats:
        """Plots and plot space (2, ...) of all cells before each spoke and ring."""
        rings = slice(self.first, self.first + len(self.depth))
        plots, looks = self.map.count[:, rings], self.map.looks[:, rings]
        return np.stack([_sum_up(plots), _sum_up(looks * self.depth)])

    def turns_of_clutter(self, azimuth: float) -> float:
        """Return the clutter from azimuth 0 to this one [rad], 1: that of a whole turn."""
        return self.map.turns_of_clutter(azimuth)


def _sum_up(values: Floats) -> Floats:
    """Return the sums, in a row, over spokes, which go on past a whole turn, and rings before."""
    sums = np.zeros((SPOKES + 1, values.shape[1] + 1))
    values.cumsum(axis=1, out=sums[1:, 1:])
    sums = sums.cumsum(axis=0)
    turn = sums[-1]
    return np.concatenate([sums[-1 - _PAD : -1] - turn, sums, sums[1 : _PAD + 1] + turn]).ravel()
