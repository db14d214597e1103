# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Can own ship be where its odometry says?

One place that is far from where the last ones led must not throw all tracks off. It is refused;
only when several in a row agree with each other has own ship, or the origin of its frame, truly
moved, and tracking starts anew.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

import numpy as np

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import Floats
from tracking_core.platform import Platform

AGREEING = 3  # places in a row that make a leap believed
SPREAD = 4.0  # standard deviations by which two places may differ and still agree


@dataclass(frozen=True)
class _Place:
    """One sample, and how fast own ship seemed to move towards it."""

    time: float  # [s]
    position: Floats  # (3,) [m]
    velocity: Floats  # (3,) as told; zero where the odometry has no twist [m/s]
    pace: Floats | None  # (3,) from the sample before to this one [m/s]
    variance: float  # of the position as told, all axes together [m^2]

    def off(self, later: _Place) -> float:
        """Return how far [m] a later place is from where this one led, by twist or by pace."""
        step = later.time - self.time
        moved = later.position - self.position
        told = np.linalg.norm(moved - 0.5 * step * (self.velocity + later.velocity))
        if self.pace is None:
            return float(told)
        return float(min(told, np.linalg.norm(moved - step * self.pace)))

    def doubt(self, later: _Place) -> float:
        """Return how far [m] the two places may be apart by what they do not know themselves."""
        return SPREAD * math.sqrt(self.variance + later.variance)


class LeapGuard:
    """
    Judge the places of one platform.

    Parameters
    ----------
    limit : float
        A place may be so far from where the last ones led [m], and farther where its covariance
        says that it is not known so well; 0: anywhere.
    memory : float
        After a longer silence nothing is known [s].

    """

    def __init__(self, limit: float, memory: float) -> None:
        self._limit, self._memory = limit, memory
        self.reset()

    def reset(self) -> None:
        """Forget all places; the next one is believed."""
        self._last: _Place | None = None
        self._newest: _Place | None = None  # believed or not
        self._strangers = 0

    def accept(self, sample: Platform) -> bool:
        """
        Return whether own ship has leapt for good; raises BadMessage for a place to be ignored.

        Parameters
        ----------
        sample : Platform
            One odometry, newer than those before.

        """
        place, before, last = self._place(sample), self._newest, self._last
        self._newest = place
        if before is None or last is None or place.time - before.time > self._memory:
            return self._believe(place, False)
        if self._limit == 0.0 or last.pace is None or self._leads_to(last, place):
            return self._believe(place, False)
        agrees = before is not last and self._leads_to(before, place)
        self._strangers = self._strangers + 1 if agrees else 1
        if self._strangers >= AGREEING:
            return self._believe(place, True)
        raise BadMessage(
            'own ship leaps',
            f'pose.pose.position is {last.off(place):.0f} m from where the last ones led; '
            f'limit {self._limit + last.doubt(place):.0f} m (ownship_leap)',
        )

    def _leads_to(self, place: _Place, later: _Place) -> bool:
        return place.off(later) <= self._limit + place.doubt(later)

    def _believe(self, place: _Place, has_leapt: bool) -> bool:
        self._last, self._strangers = place, 0
        return has_leapt

    def _place(self, sample: Platform) -> _Place:
        time, position = float(sample.time[0]), sample.position[0]
        before, pace = self._newest, None
        if before is not None and 0.0 < time - before.time <= self._memory:
            pace = (position - before.position) / (time - before.time)
        variance = float(np.trace(sample.position_covariance[0]))
        return _Place(time, position, sample.velocity[0], pace, variance)
