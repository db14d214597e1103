# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts that go from place to place: they turn, hurry, slow down, and stop there or not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.simulated_scene import Rng
from tracking_tools.scenarios.legs import Leg, Legs

Place = tuple[float, float]  # east and north [m]
_BEFORE = 1e-9  # s: the state that a leg ends with
_SLOW = 1e-3  # m/s, and s: nothing to divide by is less


@dataclass(frozen=True)
class Kind:
    """Contacts that move alike."""

    speed: tuple[float, float]  # [m/s]
    acceleration: float  # at most, along and across [m/s^2]
    turn: float  # at most [rad/s]
    stops: float = 0.0  # share of the ways that end at rest
    rest: float = 0.0  # mean time there [s]
    height: tuple[float, float] = (0.0, 0.0)  # [m]
    size: float = 0.0  # length [m]


DRONE = Kind((3.0, 22.0), 5.0, 1.0, stops=0.4, rest=10.0, height=(20.0, 150.0))
BIRD = Kind((7.0, 16.0), 4.0, 0.5, height=(10.0, 150.0))
PERSON = Kind((0.5, 2.0), 1.0, 1.5, stops=0.3, rest=4.0)
AIRLINER = Kind((5.0, 15.0), 1.0, 0.15, stops=0.5, rest=20.0, size=40.0)
VEHICLE = Kind((5.0, 20.0), 2.5, 0.5, stops=0.4, rest=10.0, size=6.0)
CAR = Kind((4.0, 16.0), 3.0, 0.5, stops=0.4, rest=4.0, size=4.0)
ROBOT = Kind((0.3, 2.5), 1.5, 1.0, stops=0.4, rest=3.0)


def within(rng: Rng, near: float, far: float, half_sector: float) -> Callable[[], Place]:
    """Return a chooser of places before a radar, even in space."""

    def anywhere() -> Place:
        distance = np.sqrt(rng.uniform(near**2, far**2))
        azimuth = rng.uniform(-half_sector, half_sector)
        return float(distance * np.cos(azimuth)), float(distance * np.sin(azimuth))

    return anywhere


def inside(rng: Rng, middle: float, side: float) -> Callable[[], Place]:
    """Return a chooser of places in a square ahead, given its middle and half its side [m]."""
    return lambda: (middle + float(rng.uniform(-side, side)), float(rng.uniform(-side, side)))


def wander(rng: Rng, kind: Kind, anywhere: Callable[[], Place], duration: float) -> Legs:
    """Return a contact that goes from place to place for so long [s], or a little longer."""
    start, speed = anywhere(), rng.uniform(*kind.speed)
    height, course = rng.uniform(*kind.height), rng.uniform(-np.pi, np.pi)
    path = Legs((*start, height), speed, course)
    while path.end < duration:
        path = replace(path, legs=path.legs + _way(rng, kind, path, anywhere()))
    return path


def _way(rng: Rng, kind: Kind, path: Legs, goal: Place) -> tuple[Leg, ...]:
    """Return the turn towards a place, the way there, and perhaps a stop."""
    (x, y, _), (vx, vy, _) = (row.tolist() for row in path.at(path.end - _BEFORE))
    speed, wanted = max(float(np.hypot(vx, vy)), _SLOW), rng.uniform(*kind.speed)
    angle = np.arctan2(goal[1] - y, goal[0] - x) - np.arctan2(vy, vx)
    angle = float((angle + np.pi) % (2.0 * np.pi) - np.pi)
    rate = min(rng.uniform(0.3, 1.0) * kind.turn, kind.acceleration / speed)
    push = rng.uniform(0.3, 1.0) * kind.acceleration
    change, brake = abs(wanted - speed) / push + _SLOW, wanted / push
    legs = [
        Leg(abs(angle) / rate + _SLOW, float(np.copysign(rate, angle))),
        Leg(change, acceleration=(wanted - speed) / change),
        Leg(0.7 * float(np.hypot(goal[0] - x, goal[1] - y)) / wanted + 1.0),
    ]
    if rng.random() < kind.stops:
        legs += [Leg(brake, acceleration=-push), Leg(rng.exponential(kind.rest) + 1.0)]
    return tuple(legs)
