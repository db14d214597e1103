# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How dense are plots that no known contact makes? False ones, and those of new contacts."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from tracking_core.batches import Floats, Scan
from tracking_core.clutter import Clutter, estimate_density
from tracking_core.clutter_map import looks_at_spokes, part_of_look
from tracking_core.clutter_pattern import Pattern
from tracking_core.linalg import TURN
from tracking_core.sensing import Sensor

_Relief = TypeVar('_Relief', float, Floats)


@dataclass(frozen=True)
class Density:
    """
    Sources of plots other than known contacts, per unit of plot space and look.

    Where the clutter is uneven there is a pattern; `relief` is its density over the mean, 1 where
    nothing is known of a pattern.
    """

    clutter: float  # the mean
    new_contacts: float
    leniency: float = 1.0  # tentative tracks may be so much less likely than usual
    pattern: Pattern | None = None
    at_plots: Floats = field(default_factory=lambda: np.ones(1))  # relief (M,) at a scan's plots

    def relief(self, position: Floats) -> Floats:
        """Return the relief (K,) at places (K, d)."""
        return self.pattern.relief(position) if self.pattern else np.ones(len(position))

    def turns_of_clutter(self, azimuth: float) -> float:
        """Return the clutter from azimuth 0 to this one [rad], 1: that of a whole turn."""
        return self.pattern.turns_of_clutter(azimuth) if self.pattern else azimuth / TURN

    def total(self, relief: _Relief) -> _Relief:
        """Return the density of all plots that no known contact makes."""
        return self.clutter * relief + self.new_contacts

    def existence(self, relief: _Relief) -> _Relief:
        """Return the chance that a plot of no known contact is from a new one."""
        return self.new_contacts / self.total(relief)


def expected_density(
    clutter: Clutter, told: float, arrivals: float, scan: Scan, sensor: Sensor, leniency: float
) -> Density:
    """
    Return what is to be expected of a scan before its plots are shared.

    Parameters
    ----------
    clutter : Clutter
        As learnt so far.
    told : float
        Density that the parameters tell, 0: none.
    arrivals : float
        New contacts expected in the whole coverage since the last look.
    scan : Scan
        M plots; if nothing is known yet, all are taken for clutter.
    sensor : Sensor
        Whose plots they are.
    leniency : float
        Of the density returned.

    """
    mean = told or clutter.density
    if mean == 0.0:
        share = part_of_look(looks_at_spokes(scan.coverage), scan.coverage) or 1.0
        mean, _ = estimate_density(0.0, 0.0, len(scan), scan.volume, share)
    pattern, at_plots = None, np.ones(len(scan))
    if not told and not clutter.map.is_flat:
        pattern = Pattern.of(clutter.map, mean, scan, sensor)
        at_plots = pattern.relief(scan.position) if pattern else at_plots
    return Density(mean, arrivals / scan.volume, leniency, pattern, at_plots)
