# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What must the tracker know of a sensor beyond its plots?"""

from __future__ import annotations

from typing import Protocol

from tracking_core.batches import Coverage, Floats
from tracking_core.space import Space


class Sensor(Protocol):
    """Measurement model, as far as it is needed where there is no plot."""

    @property
    def dimensions(self) -> int:
        """Number d of coordinates of a plot."""
        ...

    @property
    def space(self) -> Space:
        """Where its plots are: points or angles."""
        ...

    @property
    def detection_probability(self) -> float:
        """Chance that a look at a contact gives a plot."""
        ...

    @property
    def range_rate_density(self) -> float:
        """Density of the range rates of false plots [s/m]."""
        ...

    def noise(self, position: Floats, coverage: Coverage) -> Floats:
        """Return the plot covariance (T, d, d) expected at positions (T, d)."""
        ...

    def plot_space_volume(self, range_max: Floats) -> Floats:
        """Return the plot space nearer than these distances (K,) [m]."""
        ...

    def clutter_volume(self, position: Floats, coverage: Coverage) -> Floats:
        """Return the plot space in a unit of position space at positions (T, d)."""
        ...
