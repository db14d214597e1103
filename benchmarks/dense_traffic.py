# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How does traffic look that is as dense with ten contacts as with ten thousand?

Contacts fly straight legs and turns through a disc around a turning antenna. The noise is the
same in all places, false plots are as frequent as contacts, and the spacing is such that the gate
of a steady track holds about 0.25 plots that are not its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tracking_core.batches import Floats, Plots

PERIOD = 4.0  # of a turn [s]
NOISE = 100.0  # sd on each axis [m]
SPEED = 50.0  # [m/s]
DETECTION = 0.9
HEIGHTS = (1000.0, 4000.0)  # [m]
_IN_GATE = 0.13  # false plots; with those of neighbours about 0.25
_GATE_VOLUME = {2: 6.8e5, 3: 5.0e8}  # of a steady track [m^2], [m^3], median
_TURN_RATES = (0.017, 0.052)  # [rad/s]
_STRAIGHT, _TURN = 100.0, 25.0  # mean lengths of legs [s]

PARAMETERS: dict[str, Any] = {
    'sensor.position_sd': NOISE,
    'sensor.detection_probability': DETECTION,
    'motion.horizontal.acceleration_sd': [0.2, 2.0],
    'motion.horizontal.sojourn_time': [_STRAIGHT, _TURN],
    'motion.vertical.acceleration_sd': [0.2, 2.0],
    'motion.vertical.sojourn_time': [_STRAIGHT, _TURN],
    'initiation.speed_max': 60.0,
    'initiation.climb_max': 15.0,
    'merge.distance': 0.5,
    'max_tracks': 100_000,
}


@dataclass(frozen=True)
class Traffic:
    """A disc with `count` contacts in it."""

    count: int
    dimensions: int = 2
    clutter: float = 1.0  # times the usual, after the calm turns
    calm: int = 20  # turns
    seed: int = 1

    @property
    def spacing(self) -> float:
        """Side of the square that a contact has for itself [m]."""
        return float(np.sqrt(_GATE_VOLUME[self.dimensions] / _IN_GATE / self.depth))

    @property
    def depth(self) -> float:
        """Of the layer of contacts and false plots [m], 1 for a 2-D radar."""
        return HEIGHTS[1] - HEIGHTS[0] if self.dimensions == 3 else 1.0

    @property
    def radius(self) -> float:
        """Of the disc [m]."""
        return self.spacing * float(np.sqrt(self.count / np.pi))

    def clutter_at(self, turn: int) -> float:
        """Return how many times the usual number of false plots this turn has."""
        return 1.0 if turn < self.calm else self.clutter

    def parameters(self, turn: int = 0) -> dict[str, Any]:
        """Return the parameters of a tracker for this traffic."""
        stay = 0.5 * np.pi * self.radius / SPEED  # mean time across the disc
        volume = self.count * self.spacing**2 * self.depth
        seen = {'sensor.range_max': self.radius}
        if self.dimensions == 3:
            farthest = float(np.hypot(self.radius, HEIGHTS[1]))
            # So that the volume in view is that of the layer.
            span = 1.5 * volume / (np.pi * farthest**3)
            seen = {'sensor.range_max': farthest, 'sensor.elevation_span': span}
        return {
            **PARAMETERS,
            **seen,
            'existence.lifetime': stay,
            'existence.new_contacts': 3600.0 * self.count / stay,
            'clutter_density': self.clutter_at(turn) * self.count / volume,
        }


def messages(traffic: Traffic, turns: int) -> Iterator[Plots]:
    """Yield the plots of each turn; contacts enter and leave the disc all the time."""
    rng = np.random.default_rng(traffic.seed)
    d, outer = traffic.dimensions, traffic.radius + SPEED * PERIOD * turns
    contacts = rng.poisson(traffic.count * (outer / traffic.radius) ** 2)
    position = _scatter(contacts, outer, d, rng)
    course = rng.uniform(-np.pi, np.pi, contacts)
    turn_rate = np.zeros(contacts)
    for turn in range(turns):
        turn_rate = _fly_on(turn_rate, rng)
        velocity = np.zeros((contacts, d))
        velocity[:, 0], velocity[:, 1] = SPEED * np.cos(course), SPEED * np.sin(course)
        lag = _lag(position + velocity * _lag(position)[:, None])
        seen = position + velocity * lag[:, None]
        found = np.linalg.norm(seen[:, :2], axis=1) < traffic.radius
        found &= rng.random(contacts) < DETECTION
        plots = seen[found] + NOISE * rng.standard_normal((int(found.sum()), d))
        false = rng.poisson(traffic.clutter_at(turn) * traffic.count)
        clutter = _scatter(false, traffic.radius, d, rng)
        time = turn * PERIOD + np.concatenate([lag[found], _lag(clutter)])
        order = np.argsort(time, kind='stable')
        joined = np.concatenate([plots, clutter])[order]
        yield replace(Plots.cartesian(time[order], joined), stamp=turn * PERIOD)
        position, course = position + velocity * PERIOD, course + turn_rate * PERIOD


def _scatter(count: int, radius: float, d: int, rng: np.random.Generator) -> Floats:
    distance, angle = radius * np.sqrt(rng.random(count)), rng.uniform(-np.pi, np.pi, count)
    flat = np.stack([distance * np.cos(angle), distance * np.sin(angle)], axis=1)
    height = rng.uniform(*HEIGHTS, (count, d - 2))
    return np.concatenate([flat, height], axis=1)


def _fly_on(turn_rate: Floats, rng: np.random.Generator) -> Floats:
    """Begin and end turns."""
    count = len(turn_rate)
    length = np.where(turn_rate == 0.0, _STRAIGHT, _TURN)
    changes = rng.random(count) < 1.0 - np.exp(-PERIOD / length)
    begun = rng.uniform(*_TURN_RATES, count) * rng.choice([-1.0, 1.0], count)
    return np.where(changes, np.where(turn_rate == 0.0, begun, 0.0), turn_rate)


def _lag(position: Floats) -> Floats:
    """Return when in its turn, clockwise from north, the antenna points there (M,) [s]."""
    azimuth = np.arctan2(position[:, 1], position[:, 0])
    return np.asarray(((np.pi / 2.0 - azimuth) / (2.0 * np.pi) % 1.0) * PERIOD)
