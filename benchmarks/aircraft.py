# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Aircraft before a 3-D terminal radar that sees them less often, or tells less, than it says."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from benchmarks.real_data import PROJECT
from benchmarks.simulated_scene import (
    antenna,
    Part,
    passes,
    Rng,
    Scene,
    there_of,
    times_of,
    truth_of,
    turns_of,
)
from tracking_core.batches import Bools, Floats
from tracking_tools.parameter_file import read_parameter_file
from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.passes import TrueStates

TURN_TIME, TURNS, FARTHEST = 4.0, 120, 120e3  # [s], [m]
SD = np.array([50.0, 0.00175, 0.0026])  # of range [m], azimuth and elevation [rad]
AIRCRAFT, FALSE_PLOTS, RADIUS = 20, 20, 1500.0  # [m]
HIGHEST = 0.6  # of false plots [rad]
Chance = Callable[[TrueStates], Floats]  # of a plot, at each pass (P,)
VALUES = read_parameter_file(PROJECT / 'config' / 'terminal_radar.yaml', '/radar_tracker')


def even(chance: float) -> Chance:
    """Return the same chance for all."""
    return lambda states: np.full(len(states), chance)


def by_range(states: TrueStates) -> Floats:
    """Return 0.95 near the radar, 0.4 at its limit."""
    return np.asarray(0.95 - 0.55 * (np.linalg.norm(states.position, axis=1) / FARTHEST) ** 2)


def with_notch(states: TrueStates) -> Floats:
    """Return none where the range changes by less than 15 m/s, else 0.9."""
    line = states.position / np.linalg.norm(states.position, axis=1, keepdims=True)
    return 0.9 * (np.abs((states.velocity * line).sum(axis=1)) >= 15.0)


def aircraft(seed: int, chance: float | Chance = 0.9, without_height: float = 0.0) -> Scene:
    """Return eight minutes of aircraft; so many of their plots tell no height."""
    rng = np.random.default_rng(seed)
    states = passes(RADAR, traffic(rng), TURNS)
    polar, time = seen(rng, states, even(chance) if isinstance(chance, float) else chance)
    polar[rng.random(len(polar)) < without_height, 2] = np.nan
    return scene(rng, states, AIRCRAFT, [(polar, time)])


def scene(
    rng: Rng,
    states: TrueStates,
    contacts: int,
    plots: Sequence[tuple[Floats, Floats]],
    parts: tuple[Part, ...] = (Part(),),
    turns: int = TURNS,
) -> Scene:
    """Return the scene of plots (M, 3) with their times (M,), and even clutter."""
    polar, time = (np.concatenate(x) for x in zip(*plots, false_plots(rng, turns), strict=True))
    return Scene(
        VALUES, turns_of(polar, time, TURN_TIME, turns), truth_of(states, 3),
        there_of(states, TURN_TIME, turns, contacts), RADIUS, parts=parts,
    )  # fmt: skip


def traffic(rng: Rng, count: int = AIRCRAFT) -> list[Legs]:
    """Return aircraft that fly straight for minutes, climb or descend, and turn."""
    found = []
    for _ in range(count):
        distance = 0.95 * FARTHEST * np.sqrt(rng.uniform(0.01, 1.0))
        bearing, course = rng.uniform(-np.pi, np.pi, 2)
        place = (distance * np.cos(bearing), distance * np.sin(bearing))
        legs: list[Leg] = []
        while sum(leg.duration for leg in legs) < TURNS * TURN_TIME:
            climb = rng.choice([0.0, 0.0, 5.0, -5.0])
            rate, angle = rng.uniform(0.015, 0.04), rng.uniform(0.3, 2.0)
            legs.append(Leg(rng.exponential(120.0) + 20.0, climb_rate=climb))
            legs.append(Leg(angle / rate, rng.choice([-1.0, 1.0]) * rate, climb_rate=0.0))
        height = rng.uniform(2500.0, 10e3)
        found.append(Legs((*place, height), rng.uniform(80.0, 200.0), course, tuple(legs)))
    return found


def seen(rng: Rng, states: TrueStates, chance: Chance) -> tuple[Floats, Floats]:
    """Return range, azimuth and elevation (M, 3) of the plots of contacts, and their times."""
    hit = rng.random(len(states)) < chance(states)
    polar = polar_of(states.position[hit])
    return polar + SD * rng.standard_normal(polar.shape), states.time[hit]


def false_plots(rng: Rng, turns: int = TURNS) -> tuple[Floats, Floats]:
    """Return plots of nobody, even in range, azimuth and elevation."""
    number = rng.poisson(FALSE_PLOTS, turns)
    edge = [FARTHEST, 2.0 * np.pi, HIGHEST]
    polar = rng.uniform([2e3, 0.0, 0.0], edge, (number.sum(), 3))
    return polar, times_of(polar[:, 1], np.repeat(np.arange(turns), number), TURN_TIME)


def polar_of(position: Floats) -> Floats:
    """Return range, azimuth and elevation (N, 3) of places (N, 3)."""
    x, y, z = position.T
    return np.column_stack(
        [np.linalg.norm(position, axis=1), np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))]
    )


def within(azimuth: float, width: float) -> Callable[[Floats], Bools]:
    """Return whether places (N, d) lie in a sector [rad]."""

    def inside(position: Floats) -> Bools:
        off = np.arctan2(position[:, 1], position[:, 0]) - azimuth
        return np.asarray(np.abs((off + np.pi) % (2.0 * np.pi) - np.pi) < 0.5 * width)

    return inside


RADAR = antenna(TURN_TIME, FARTHEST, SD)
