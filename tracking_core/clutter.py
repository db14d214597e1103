# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How many false plots does a look give? Counted among the plots that no track explains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Bools, Coverage, Floats, Ints, Scan
from tracking_core.clutter_map import (
    cells,
    ClutterMap,
    JUMP,
    JUMP_PLOTS,
    looks_at_spokes,
    MEMORY,
    part_of_look,
)  # fmt: skip
from tracking_core.sensing import Sensor

_LEAST_PLOTS = 0.5  # false plots of a look that are assumed at least: none seen is not none ever
_UNCLAIMED = 0.7  # of a new contact's plots: part was claimed as its chance to exist rose


@dataclass(frozen=True)
class Clutter:
    """What has been learnt of false plots."""

    map: ClutterMap  # where they are
    density: float = 0.0  # mean over the coverage, per unit of plot space; 0: not known yet
    looks: float = 0.0  # full looks that it is from

    def learn(self, scan: Scan, unexplained: Floats, counted: Bools, sensor: Sensor) -> Clutter:
        """
        Return what is known after one more scan.

        Parameters
        ----------
        scan : Scan
            M plots.
        unexplained : (M,) array
            Chance of each that no track made it.
        counted : (M,) array
            The others wait for the next scan.
        sensor : Sensor
            Whose plots they are.

        """
        coverage, plots = scan.coverage, unexplained[counted]
        at_spokes, total = looks_at_spokes(coverage), float(plots.sum())
        share = part_of_look(at_spokes, coverage)
        if share == 0.0:
            return self
        known = 0.0 if self._has_jumped(total, scan.volume * share, at_spokes) else self.looks
        density, looks = estimate_density(self.density, known, total, scan.volume, share)
        cell = cells(sensor.space, coverage.sensor_position, scan.position[counted])
        return Clutter(self.map.add(cell, plots, at_spokes, share), density, looks)

    def without(self, places: Floats, plots: Ints, coverage: Coverage, sensor: Sensor) -> Clutter:
        """
        Return what is known now that contacts at places (K, d) are.

        Of the plots (K,) that each has had, some were taken for false ones. While they stand in
        the map, contacts near each other are clutter to each other, and some are never found.
        """
        cell = cells(sensor.space, coverage.sensor_position, places)
        known = self.map.without(cell, _UNCLAIMED * np.minimum(plots, MEMORY))
        return Clutter(known, self.density, self.looks)

    def _has_jumped(self, plots: float, space: float, at_spokes: Floats) -> bool:
        """Return whether the sea got up, or a jammer went on: what was learnt is void."""
        if plots <= JUMP * self.density * space + JUMP_PLOTS:
            return False
        return plots > JUMP * self.map.expected(at_spokes) + JUMP_PLOTS  # else always so there

    def times(self, factor: float) -> Clutter:
        """Return the same plots in a larger space, or a smaller one."""
        return Clutter(self.map, self.density * factor, self.looks)


def estimate_density(
    old: float, looks: float, unexplained: float, volume: float, share: float
) -> tuple[float, float]:
    """
    Return the clutter density after one more scan, and from how many looks it is.

    Parameters
    ----------
    old, looks : float
        Estimate so far, and from how many full looks it is.
    unexplained : float
        Sum over the plots of the chance that no track made them.
    volume : float
        Of the whole coverage in plot space.
    share : float
        Part of a full look that this scan was, 1: all of one.

    """
    looks = min(looks + share, MEMORY)
    new = old + min(share / looks, 1.0) * (unexplained / (volume * share) - old)
    return max(new, _LEAST_PLOTS / volume), looks
