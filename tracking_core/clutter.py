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
)  # fmt: skip
from tracking_core.sensing import Sensor

_LEAST_PLOTS = 0.5  # false plots of a look that are assumed at least: none seen is not none ever
_UNCLAIMED = 0.5  # of a new contact's plots: the chance that it exists rose from 0 to 1


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
        density, looks = estimate_density(
            self.density, self.looks, float(plots.sum()), scan.volume, coverage.part_of_look
        )
        looks_now = looks_at_spokes(coverage)
        cell = cells(sensor.space, coverage.sensor_position, scan.position[counted])
        clutter_map = self.map.add(cell, plots, looks_now, coverage.part_of_look)
        return Clutter(clutter_map, density, looks)

    def without(self, places: Floats, plots: Ints, coverage: Coverage, sensor: Sensor) -> Clutter:
        """
        Return what is known now that contacts at places (K, d) are.

        Of so many plots (K,) that each has had, some were taken for false ones. While they stand
        in the map, contacts near each other are clutter to each other, and some are never found.
        """
        cell = cells(sensor.space, coverage.sensor_position, places)
        known = self.map.without(cell, np.asarray(_UNCLAIMED * plots))
        return Clutter(known, self.density, self.looks)

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
        Part of a full look that this scan was, in (0, 1].

    """
    usual = old * volume * share
    if unexplained > JUMP * usual + JUMP_PLOTS:
        looks = 0.0  # the sea got up, or a jammer went on: what was learnt is void
    looks = min(looks + share, MEMORY)
    new = old + min(share / looks, 1.0) * (unexplained / (volume * share) - old)
    return max(new, _LEAST_PLOTS / volume), looks
