# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does own ship move over the ground as its heading and twist say?

A twist in the axes of the wrong frame, none at all, or a heading that counts from north put
contacts in wrong places and falsify range rates, but only while own ship turns. Its path tells
at once.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tracking_core.batches import Floats
from tracking_core.platform import Platform
from tracking_session.doubts import Doubt

SPAN = 10.0  # s of the path that are compared
LEAST = 10.0  # m that path and twist must be apart
_PART = 0.5  # of the way, likewise
_SPREAD = 4.0  # standard deviations of a place, likewise
_AGREEING = 3  # spans in a row that show the same


class TwistCheck:
    """
    Compare path and twist of one platform.

    Parameters
    ----------
    memory : float
        A longer silence ends a span [s].

    """

    def __init__(self, memory: float) -> None:
        self._memory = memory
        self.reset()

    def reset(self) -> None:
        """Forget the path."""
        self._first: Platform | None = None  # of the span
        self._last: Platform | None = None
        self._led = np.zeros(2)  # how far the twist led since the first [m]
        self._count = 0  # spans in a row that path and twist were apart
        self._moved, self._told = np.zeros(2), np.zeros(2)  # in the last span [m/s]

    def take(self, sample: Platform) -> None:
        """Take the next sample, newer than those before."""
        first, last = self._first, self._last
        self._last = sample
        if first is None or last is None or sample.time[0] - last.time[0] > self._memory:
            self._first, self._led = sample, np.zeros(2)
            return
        step = float(sample.time[0] - last.time[0])
        self._led = self._led + 0.5 * step * (last.velocity[0] + sample.velocity[0])[:2]
        if sample.time[0] - first.time[0] >= SPAN:
            self._compare(first, sample)
            self._first, self._led = sample, np.zeros(2)

    def _compare(self, first: Platform, last: Platform) -> None:
        moved = (last.position[0] - first.position[0])[:2]
        variance = (first.position_covariance + last.position_covariance)[0, :2, :2]
        way = max(np.linalg.norm(moved), np.linalg.norm(self._led))
        limit = max(_PART * way, LEAST + _SPREAD * np.sqrt(np.trace(variance)))
        is_apart, span = np.linalg.norm(moved - self._led) > limit, last.time[0] - first.time[0]
        self._count = self._count + 1 if is_apart else 0
        self._moved, self._told = moved / span, self._led / span

    def doubts(self) -> Iterator[Doubt]:
        """Yield what is wrong."""
        if self._count >= _AGREEING:
            yield Doubt(
                'own ship does not move as its twist says',
                f'own ship moves by {_words(self._moved)}, by its heading and twist it should by '
                f'{_words(self._told)}: twist.twist.linear must be in the axes of child_frame_id, '
                'and the heading anticlockwise from the x axis of header.frame_id (REP 103, 105)',
            )


def _words(velocity: Floats) -> str:
    """Return a velocity over the ground in words."""
    speed = np.hypot(*velocity)
    if speed < LEAST / SPAN:
        return f'{speed:.1f} m/s'
    return f'{speed:.1f} m/s at {np.degrees(np.arctan2(velocity[1], velocity[0])):.0f} degrees'
