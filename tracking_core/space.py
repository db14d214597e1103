# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What changes when plots are angles, not points? Angles come again every turn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from tracking_core.batches import Floats, Ints
from tracking_core.gating import box_pairs, MOST_PAIRS, sector_pairs
from tracking_core.linalg import nearest_turn, wrap_angle
from tracking_core.rows import take_rows

Point = tuple[float, float, float]


class Space(Protocol):
    """Where plots and tracks are, and how near they are to each other there."""

    has_range: ClassVar[bool]  # places are at a distance from the sensor

    def find_pairs(
        self, centre: Floats, half_size: Floats, plots: Floats, most: int = MOST_PAIRS
    ) -> tuple[Ints, Ints]:
        """Return boxes and plots inside them (P,), (P,), as `gating.box_pairs`."""
        ...

    def beside(self, place: Floats, reference: Floats, row: Ints) -> Floats:
        """Return the places (P, d), told so as to be near these rows of the references (T, d)."""
        ...

    def shortest(self, way: Floats) -> Floats:
        """Return the ways (..., n) between places or states, the short way round."""
        ...

    def seen_from(self, origin: Point, place: Floats) -> tuple[Floats, Floats]:
        """Return distance (K,) [m], 0 without one, and azimuth (K,) [rad] of places (K, d)."""
        ...

    def comparable(self, mean: Floats, covariance: Floats) -> tuple[Floats, Floats]:
        """Return that part of states (T, n) that plots soon tell of."""
        ...


@dataclass(frozen=True)
class Points:
    """A space without end [m]."""

    has_range: ClassVar[bool] = True

    def find_pairs(
        self, centre: Floats, half_size: Floats, plots: Floats, most: int = MOST_PAIRS
    ) -> tuple[Ints, Ints]:
        """Return what is inside the boxes."""
        return box_pairs(centre, half_size, plots, most)

    def beside(self, place: Floats, reference: Floats, row: Ints) -> Floats:
        """Return the places: there is one way to tell them."""
        return place

    def shortest(self, way: Floats) -> Floats:
        """Return the ways: they are straight."""
        return way

    def seen_from(self, origin: Point, place: Floats) -> tuple[Floats, Floats]:
        """Return distance over the ground and azimuth."""
        x, y = place[:, 0] - origin[0], place[:, 1] - origin[1]
        return np.hypot(x, y), np.arctan2(y, x)

    def comparable(self, mean: Floats, covariance: Floats) -> tuple[Floats, Floats]:
        """Return all."""
        return mean, covariance


@dataclass(frozen=True)
class Angles:
    """A circle; the first coordinate of a state is the angle, the second its rate [rad]."""

    has_range: ClassVar[bool] = False

    def find_pairs(
        self, centre: Floats, half_size: Floats, plots: Floats, most: int = MOST_PAIRS
    ) -> tuple[Ints, Ints]:
        """Return what is inside the sectors."""
        return sector_pairs(centre, half_size, plots, most)

    def beside(self, place: Floats, reference: Floats, row: Ints) -> Floats:
        """Return the angles within half a turn of the references."""
        return nearest_turn(place, take_rows(reference, row))

    def shortest(self, way: Floats) -> Floats:
        """Return the ways with an angle of less than half a turn."""
        short = way.copy('K')
        short[..., 0] = wrap_angle(way[..., 0])
        return short

    def seen_from(self, origin: Point, place: Floats) -> tuple[Floats, Floats]:
        """Return no distance, and the angles."""
        return np.zeros(len(place)), place[:, 0]

    def comparable(self, mean: Floats, covariance: Floats) -> tuple[Floats, Floats]:
        """Return angle and rate: what else there is, a range, bearings hardly tell."""
        return mean[:, :2], covariance[:, :2, :2]


POINTS, ANGLES = Points(), Angles()
