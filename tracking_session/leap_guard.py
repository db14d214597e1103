# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Can own ship be where its odometry says?

One place that is far from where the last ones led must not throw all tracks off. It is refused;
only when several in a row agree with each other has own ship, or the origin of its frame, truly
moved, and tracking starts anew. After a silence own ship may be wherever it can have gone.
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
_SPEEDS_UP = 1.0  # m/s^2, in a silence


@dataclass(frozen=True)
class _Place:
    """One sample, and how fast own ship seemed to move towards it."""

    time: float  # [s]
    position: Floats  # (3,) [m]
    velocity: Floats  # (3,) as told; zero where the odometry has no twist [m/s]
    pace: Floats | None  # (3,) from the sample before to this one [m/s]
    covariance: Floats  # (3, 3) of the position as told [m^2]

    def off(self, later: _Place) -> Floats:
        """Return how far (3,) [m] a later place is from where this led, by twist or by pace."""
        step = later.time - self.time
        moved = later.position - self.position
        told = moved - 0.5 * step * (self.velocity + later.velocity)
        if self.pace is None:
            return np.asarray(told)
        return np.asarray(min(told, moved - step * self.pace, key=np.linalg.norm))

    def doubt(self, later: _Place) -> float:
        """Return how far [m] the later place may be off by what the two do not know themselves."""
        off = self.off(later)
        way = off / max(float(np.linalg.norm(off)), 1e-9)
        variance = float(way @ (self.covariance + later.covariance) @ way)
        return SPREAD * math.sqrt(max(variance, 0.0))

    def roamed(self, later: _Place) -> float:
        """Return how far [m] the later place may be off, whatever own ship did in between."""
        step = later.time - self.time
        pace = np.zeros(3) if self.pace is None else self.pace
        fastest = max(float(np.linalg.norm(v)) for v in (self.velocity, later.velocity, pace))
        return 2.0 * fastest * step + 0.5 * _SPEEDS_UP * step**2


class LeapGuard:
    """
    Judge the places of one platform.

    Parameters
    ----------
    limit : float
        A place may be so far from where the last ones led [m], and farther where its covariance
        says that it is not known so well; 0: anywhere.
    memory : float
        After a longer silence own ship may have gone any way [s].

    """

    def __init__(self, limit: float, memory: float) -> None:
        self._limit, self._memory = limit, memory
        self.reset()

    def reset(self) -> None:
        """Forget all places; the next one is believed."""
        self._last: _Place | None = None
        self._newest: _Place | None = None  # believed or not
        self._strangers = 0
        self._is_lost = False  # there was a silence since the last place that is believed

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
        if before is None or last is None or last.pace is None or self._limit == 0.0:
            return self._believe(place, False)
        is_silent = place.time - before.time > self._memory
        self._is_lost |= is_silent
        if self._leads_to(last, place, self._is_lost):
            return self._believe(place, False)
        agrees = before is not last and self._leads_to(before, place, is_silent)
        self._strangers = self._strangers + 1 if agrees else 1
        if self._strangers >= AGREEING:
            return self._believe(place, True)
        raise BadMessage(
            'own ship leaps',
            f'pose.pose.position is {np.linalg.norm(last.off(place)):.0f} m from where the last '
            f'ones led; limit {self._reach(last, place, self._is_lost):.0f} m (ownship_leap)',
        )

    def _leads_to(self, place: _Place, later: _Place, is_lost: bool) -> bool:
        return bool(np.linalg.norm(place.off(later)) <= self._reach(place, later, is_lost))

    def _reach(self, place: _Place, later: _Place, is_lost: bool) -> float:
        """Return how far [m] a later place may be from where this one led."""
        silence = place.roamed(later) if is_lost else 0.0
        return self._limit + place.doubt(later) + silence

    def _believe(self, place: _Place, has_leapt: bool) -> bool:
        self._last, self._strangers, self._is_lost = place, 0, False
        return has_leapt

    def _place(self, sample: Platform) -> _Place:
        time, position = float(sample.time[0]), sample.position[0]
        before, pace = self._newest, None
        if before is not None and before.time < time:
            pace = (position - before.position) / (time - before.time)
        return _Place(time, position, sample.velocity[0], pace, sample.position_covariance[0])
