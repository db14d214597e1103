# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where a contact is that flies a chain of legs: exact turns, accelerations and climbs."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import factorial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tracking_core.batches import Floats

# So many terms of the series of a smaller turn [rad] are exact to rounding.
_SMALL_TURN, _TERMS = 0.3, 6


@dataclass(frozen=True)
class Leg:
    """
    A stretch of constant turn rate and constant accelerations.

    A horizontal acceleration a across the course is a turn rate of a / speed.
    """

    duration: float
    """[s]."""
    turn_rate: float = 0.0
    """Anticlockwise positive [rad/s]."""
    acceleration: float = 0.0
    """Along the horizontal course [m/s^2]."""
    vertical_acceleration: float = 0.0
    """[m/s^2]."""
    climb_rate: float | None = None
    """Climb rate that the leg starts with [m/s]; None keeps that of the leg before."""


class _Motion(NamedTuple):
    """Start and constants of legs, each (L,) or (...)."""

    x: Floats
    y: Floats
    height: Floats
    speed: Floats
    course: Floats
    climb: Floats
    turn_rate: Floats
    acceleration: Floats
    vertical_acceleration: Floats


@dataclass(frozen=True)
class Legs:
    """
    Chain of legs in closed form; straight and steady before the first and after the last.

    Parameters
    ----------
    position : (float, float, float)
        East, north, up at the start [m].
    speed : float
        Horizontal speed at the start [m/s].
    course : float
        Direction of flight at the start, anticlockwise from east [rad].
    legs : tuple of Leg
        In order of time.
    climb_rate : float
        Vertical speed at the start [m/s].
    start : float
        Time of the first leg [s].

    """

    position: tuple[float, float, float]
    speed: float
    course: float
    legs: tuple[Leg, ...] = ()
    climb_rate: float = 0.0
    start: float = 0.0
    _edges: Floats = field(init=False, repr=False, compare=False)
    _chain: _Motion = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for leg in self.legs:
            if not leg.duration > 0.0:
                raise ValueError(f'Leg.duration must be above 0 s, got {leg.duration}')
        durations = [0.0, *(leg.duration for leg in self.legs)]
        object.__setattr__(self, '_edges', self.start + np.cumsum(durations))
        object.__setattr__(self, '_chain', _chain(self))

    @property
    def end(self) -> float:
        """Time at which the last leg ends [s]."""
        return float(self._edges[-1])

    def at(self, time: ArrayLike) -> tuple[Floats, Floats]:
        """Evaluate the motion, as in ``Trajectory.at``."""
        when = np.asarray(time, dtype=float)
        leg = np.searchsorted(self._edges, when, side='right')
        since = when - self._edges[np.maximum(leg - 1, 0)]
        now = _move(_as_motion(*(column[leg] for column in self._chain)), since)
        position = np.stack([now.x, now.y, now.height], axis=-1)
        vx, vy = now.speed * np.cos(now.course), now.speed * np.sin(now.course)
        return position, np.stack([vx, vy, now.climb], axis=-1)

    def mirrored(self, x_sum: float) -> Legs:
        """Mirror image in the line x = x_sum / 2, so that x becomes x_sum - x."""
        x, y, z = self.position
        legs = tuple(replace(leg, turn_rate=-leg.turn_rate) for leg in self.legs)
        return replace(self, position=(x_sum - x, y, z), course=np.pi - self.course, legs=legs)


def _chain(path: Legs) -> _Motion:
    """Each leg's start, with a steady leg before the first and after the last: (L + 2,)."""
    now = _as_motion(*path.position, path.speed, path.course, path.climb_rate, 0.0, 0.0, 0.0)
    rows = [now]
    for leg in path.legs:
        climb = now.climb if leg.climb_rate is None else leg.climb_rate
        rates = (leg.turn_rate, leg.acceleration, leg.vertical_acceleration)
        begun = _as_motion(now.x, now.y, now.height, now.speed, now.course, climb, *rates)
        rows.append(begun)
        now = _move(begun, np.asarray(leg.duration))
    rows.append(_as_motion(*now[:-3], 0.0, 0.0, 0.0))
    return _as_motion(*(np.stack(column) for column in zip(*rows, strict=True)))


def _as_motion(*values: ArrayLike) -> _Motion:
    return _Motion(*(np.asarray(value, dtype=float) for value in values))


def _move(motion: _Motion, dt: Floats) -> _Motion:
    """
    Advance by dt [s], exactly.

    With speed s + a t and course c + w t the way along and across the first course is
    s dt E_0 + a dt^2 E_1, where E_k is the integral of v^k (cos, sin)(w dt v) over 0..1.
    """
    turn = motion.turn_rate * dt
    half = np.sinc(turn / (2.0 * np.pi))  # sin(turn / 2) / (turn / 2)
    cos_0, sin_0 = np.sinc(turn / np.pi), np.sin(0.5 * turn) * half
    cos_1, sin_1 = cos_0 - 0.5 * half**2, _first_sine_moment(turn)
    near, far = motion.speed * dt, motion.acceleration * dt**2
    along, across = near * cos_0 + far * cos_1, near * sin_0 + far * sin_1
    cos, sin = np.cos(motion.course), np.sin(motion.course)
    return motion._replace(
        x=motion.x + cos * along - sin * across,
        y=motion.y + sin * along + cos * across,
        height=motion.height + dt * (motion.climb + 0.5 * dt * motion.vertical_acceleration),
        speed=motion.speed + motion.acceleration * dt,
        course=motion.course + turn,
        climb=motion.climb + motion.vertical_acceleration * dt,
    )


def _first_sine_moment(turn: Floats) -> Floats:
    """(sin u - u cos u) / u^2, for a small turn u by its series, where the difference cancels."""
    is_small = np.abs(turn) < _SMALL_TURN
    small, large = np.where(is_small, turn, 0.0), np.where(is_small, 1.0, turn)
    series = sum(
        (-1.0) ** k * small ** (2 * k + 1) / (factorial(2 * k + 1) * (2 * k + 3))
        for k in range(_TERMS)
    )
    return np.where(is_small, series, (np.sin(large) - large * np.cos(large)) / large**2)
