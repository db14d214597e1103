# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Where do false plots come from? Rain, waves and coasts are not everywhere.

Around the sensor are cells about as long as they are wide: spokes by azimuth, cut by rings, seven
to each doubling of the range. In every cell is counted what no track explains. Read
``clutter_pattern.py`` next: what the map says of a place.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

import numpy as np

from tracking_core.batches import Bools, Coverage, Floats, Ints
from tracking_core.chances import TINY
from tracking_core.linalg import TURN
from tracking_core.space import Point, Space

SPOKES, RINGS = 64, 128
SPOKE_EDGES = np.linspace(0.0, TURN, SPOKES + 1)  # [rad]
RING_EDGES = np.concatenate([[0.0], 5.0 * 2.0 ** (np.arange(1.0, RINGS) / 7.0), [np.inf]])  # [m]
MEMORY = 10.0  # looks over which plots are counted
_FEWEST = 10.0  # plots; fewer make no pattern
_FEWEST_AT_FIRST, _FIRST = 30.0, 4.0  # nor do these in so many looks: all contacts are new then
_BESIDE = np.arange(-1, 2)  # of a cell
_BLOCK = 8  # cells each way in which a jump is looked for
JUMP, JUMP_PLOTS = 2.0, 10.0  # times the usual plus so many plots: a jump, not chance


@dataclass(frozen=True)
class ClutterMap:
    """False plots by cell; a sonar, which measures no range, has one ring."""

    count: Floats  # (A, R) plots in spokes and rings; older ones weigh less
    looks: Floats  # (A, R) at each cell, likewise

    @staticmethod
    def blank(space: Space) -> ClutterMap:
        """Return the map of a sensor that has not looked yet."""
        nothing = np.broadcast_to(0.0, (SPOKES, rings_of(space)))  # takes no memory
        return ClutterMap(nothing, nothing)

    @property
    def is_flat(self) -> bool:
        """Whether there are too few plots for a pattern."""
        at_first = self.looks.max() < _FIRST
        return bool(self.count.sum() < (_FEWEST_AT_FIRST if at_first else _FEWEST))

    def add(self, cell: Ints, plots: Floats, looks: Floats, share: float) -> ClutterMap:
        """
        Return the map after one more scan.

        Parameters
        ----------
        cell : (M,) array
            Where each plot is, see `cells`.
        plots : (M,) array
            Chance of each that no track made it.
        looks : (A,) array
            Of the scan at each spoke, see `looks_at_spokes`.
        share : float
            Part of a full look that the scan was, see `part_of_look`.

        """
        shape, size = self.count.shape, self.count.size
        fresh = np.asarray(np.bincount(cell, plots, size), np.float64).reshape(shape)
        kept: Floats | float = math.exp(-share / MEMORY)
        if _blocks(fresh).max() > JUMP_PLOTS:  # where rain sets in, the calm before is void
            kept = np.where(_have_jumped(fresh, self._usual(looks)), 0.0, kept)
        return ClutterMap(kept * self.count + fresh, kept * self.looks + looks[:, None])

    def expected(self, looks: Floats) -> float:
        """Return the plots expected of so many looks (A,) at each spoke; inf: of new ones."""
        if (looks > 0.0)[(self.looks == 0.0).all(axis=1)].any():
            return np.inf
        return float(self._usual(looks).sum())

    def _usual(self, looks: Floats) -> Floats:
        """Return the plots (A, R) that were usual in so many looks (A,) at each spoke."""
        return self.count * (looks[:, None] / np.maximum(self.looks, 1e-9))

    def without(self, cell: Ints, plots: Floats) -> ClutterMap:
        """Return the map less so many plots (K,) in or beside each cell (K,)."""
        A, R = self.count.shape
        spoke, ring = np.divmod(cell[:, None, None], R)
        spoke, ring = (spoke + _BESIDE[:, None]) % A, (ring + _BESIDE).clip(0, R - 1)
        place = (spoke * R + ring).reshape(len(cell), _BESIDE.size**2)
        count = self.count.reshape(-1)
        here = count[place]
        taken = here * (plots / np.maximum(here.sum(axis=1), TINY))[:, None]
        left = count - np.bincount(place.reshape(-1), taken.reshape(-1), A * R)
        return ClutterMap(np.maximum(left, 0.0).reshape(A, R), self.looks)

    def turns_of_clutter(self, azimuth: float) -> float:
        """Return the clutter from azimuth 0 to this one [rad], 1: that of a whole turn."""
        passed = np.append(0.0, self.count.sum(axis=1).cumsum())
        turns, angle = divmod(azimuth, TURN)
        return turns + float(np.interp(angle, SPOKE_EDGES, passed) / passed[-1])


def rings_of(space: Space) -> int:
    """Return how many rings a map of this space has."""
    return RINGS if space.has_range else 1


def cells(space: Space, origin: Point, position: Floats) -> Ints:
    """Return the cells (K,) of places (K, d), the sensor being at the origin."""
    distance, azimuth = space.seen_from(origin, position)
    spoke = np.floor(azimuth * (SPOKES / TURN)).astype(np.int64) % SPOKES
    ring = RING_EDGES.searchsorted(distance, 'right') - 1
    return np.asarray(spoke * rings_of(space) + ring)


def looks_at_spokes(coverage: Coverage) -> Floats:
    """Return how often a scan looked at each spoke (A,), 1: once."""
    width = coverage.sector_width
    begin = coverage.sector_centre - 0.5 * width
    looks = _turns(begin, begin + width)
    if coverage.sweep:
        ends = sorted((coverage.start_azimuth, coverage.start_azimuth + coverage.sweep))
        turns = _turns(*ends)
        looks = np.where(turns < 1.0, np.minimum(looks, turns), looks * turns)
    return looks


def part_of_look(looks: Floats, coverage: Coverage) -> float:
    """Return how much of all that the sensor sees it looked at; `looks` (A,) at each spoke."""
    return float(looks.sum()) * TURN / (SPOKES * coverage.sector_width)


def _turns(begin: float, end: float) -> Floats:
    """Return how often what turns from one angle to another is in each spoke (A,)."""
    passed = [
        (angle // TURN) * SPOKE_EDGES + np.minimum(angle % TURN, SPOKE_EDGES)
        for angle in (begin, end)
    ]
    return np.maximum(np.diff(passed[1] - passed[0]), 0.0) * (SPOKES / TURN)


def _have_jumped(plots: Floats, usual: Floats) -> Bools:
    """Return which cells (A, R) are in a block with far more plots than usual."""
    jumped = _blocks(plots) > JUMP * _blocks(usual) + JUMP_PLOTS
    rings = plots.shape[1] // jumped.shape[1]
    return np.asarray(jumped.repeat(_BLOCK, axis=0).repeat(rings, axis=1))


def _blocks(values: Floats) -> Floats:
    """Return the sums over blocks of cells."""
    A, R = values.shape
    rings = min(R, _BLOCK)
    return np.asarray(values.reshape(A // _BLOCK, _BLOCK, R // rings, rings).sum(axis=(1, 3)))
