# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does own ship's heading leap?

A compass that is reset puts all contacts elsewhere at once: their tracks are lost, and new ones
begin. No ship turns so, between two samples, without turning before or after.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
import math

from tracking_core.platform import Platform

LEAST = math.radians(5.0)  # leaps below harm tracks little
WINDOW = 3.0  # s before and behind, that show how own ship turns
_SAMPLES = 3  # at least, on either side
_FASTER = 2.0  # times as fast as it turns there
_SPREAD = 4.0  # standard deviations of the headings, likewise
_SPEEDS_UP = math.radians(180.0)  # rad/s^2, and slows down, between two headings
Tell = Callable[[str, str], object]
_Sample = tuple[float, float, float]  # time [s], heading [rad], its variance [rad^2]


class HeadingGuard:
    """Look for leaps of one platform's heading, with a delay of `WINDOW`."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget all headings."""
        self._samples: list[_Sample] = []
        self._judged = 0  # of them

    def take(self, platform: Platform, tell: Tell) -> None:
        """Take the next sample, newer than those before; tell of leaps, in short and at length."""
        time = float(platform.time[0])
        if self._samples and time <= self._samples[-1][0]:
            self.reset()
        x, y, z, w = platform.orientation[0].tolist()
        yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        self._samples.append((time, yaw, float(platform.yaw_variance[0])))
        while self._samples[self._judged][0] < time - WINDOW:
            at = self._judged = self._judged + 1
            if abs(_turn(*self._samples[at - 1 : at + 1])) > LEAST and self._leaps(at):
                tell("own ship's heading leaps", _words(*self._samples[at - 1 : at + 1]))
        while self._samples[0][0] < self._samples[self._judged][0] - WINDOW:
            del self._samples[0]
            self._judged -= 1

    def _leaps(self, at: int) -> bool:
        """Return whether own ship cannot have turned so from the sample before to this one."""
        before, now = self._samples[at - 1 : at + 1]
        others = [
            (one, other) for k, (one, other) in enumerate(pairwise(self._samples)) if k != at - 1
        ]
        if min(at - 1, len(others) - at + 1) < _SAMPLES:
            return False
        step = max(now[0] - before[0], _least_time([*others, (before, now)]))
        fastest = max(abs(_turn(*pair)) / (pair[1][0] - pair[0][0]) for pair in others)
        sd = math.sqrt(before[2] + now[2])
        way = LEAST + _FASTER * fastest * step + 0.25 * _SPEEDS_UP * step**2 + _SPREAD * sd
        return abs(_turn(before, now)) > way


def _least_time(pairs: list[tuple[_Sample, _Sample]]) -> float:
    """Return the time [s] from one new heading to the next: some compasses tell one many times."""
    new = sorted(other[0] for one, other in pairs if other[1] != one[1])
    return min((after - time for time, after in pairwise(new)), default=0.0)


def _turn(one: _Sample, other: _Sample) -> float:
    """Return how far it is from one heading to the other [rad], the short way round."""
    return math.remainder(other[1] - one[1], 2.0 * math.pi)


def _words(before: _Sample, now: _Sample) -> str:
    start, end, turn = (math.degrees(x) for x in (before[1], now[1], _turn(before, now)))
    return (
        f'by {turn:.0f} degrees in {now[0] - before[0]:.2g} s, from {start:.0f} to {end:.0f} '
        '(pose.pose.orientation), while it hardly turns before and after: all contacts seem to '
        'leap with it, and get new tracks. Was its compass reset?'
    )
