# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""An airport before a surface movement radar: taxiing, stops, a take-off, a landing, vehicles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.simulated_scene import Rng, Scene
from benchmarks.wanderers import AIRLINER, VEHICLE, wander, within
from benchmarks.watched_scene import Echoes, watched
from tracking_core.batches import Floats
from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.passes import TrueStates
from tracking_tools.scenarios.radar import SimulatedRadar

SURFACE = SimulatedRadar(
    1.0, 3.0, 0.002, detection_probability=0.95, clutter_per_turn=10.0,
    rotation='anticlockwise', azimuth_start=0.0, range_limits=(100.0, 4000.0),
)  # fmt: skip
LOOKS, RADIUS = 150, 60.0  # farther off, a track follows somebody else [m]
SPACING = 80.0  # of a queue [m]
WANDERING = 0.12  # sd of the middle of an echo, over the contact's length


def airport(seed: int, several: bool = False, queue: bool = False) -> Scene:
    """
    Return what taxis, stops, takes off and lands for two and a half minutes, and vehicles.

    Parameters
    ----------
    seed : int
        Of all chance.
    several : bool
        Whether an airliner gives one to five plots, and not one that wanders along it.
    queue : bool
        Six airliners move up before a runway, 80 m apart.

    """
    rng = np.random.default_rng(seed)
    kinds = [AIRLINER] * 6 + [VEHICLE] * 8
    paths = [wander(rng, kind, within(rng, 300.0, 3500.0, np.pi), LOOKS) for kind in kinds]
    off, y = rng.uniform(10.0, 40.0), rng.uniform(300.0, 800.0)
    start = (Leg(off), Leg(33.0, acceleration=2.1))
    landing = (Leg(0.5 * off), Leg(30.0, acceleration=-2.0), Leg(12.0, turn_rate=0.13))
    paths += [Legs((-1800.0, y, 0.0), 0.0, 0.0, start),
              Legs((3000.0, -y, 0.0), 68.0, np.pi, landing)]  # fmt: skip
    waits, up = rng.uniform(15.0, 40.0, 4).tolist(), (Leg(6.0, acceleration=1.0), Leg(5.0))
    moves = tuple(leg for wait in waits for leg in (Leg(wait), *up, Leg(6.0, acceleration=-1.0)))
    for k in range(6 if queue else 0):
        legs = (Leg(2.0 * k + 1.0), *moves)  # each sees the one before it move
        paths.append(Legs((500.0 - SPACING * k, 1500.0, 0.0), 0.0, 0.0, legs))
    size = np.array([kind.size for kind in (*kinds, *[AIRLINER] * (len(paths) - len(kinds)))])
    return watched(rng, SURFACE, paths, LOOKS, RADIUS, along(rng, size, several))


def along(rng: Rng, size: Floats, several: bool) -> Echoes:
    """Return that plots come from anywhere along contacts of these lengths (C,) [m]."""

    def echoes(states: TrueStates) -> tuple[TrueStates, Floats]:
        extra = rng.poisson(0.03 * size[states.id]) if several else np.zeros(len(states), int)
        shine = states.rows(np.repeat(np.arange(len(states)), 1 + extra))
        speed = np.linalg.norm(shine.velocity, axis=1, keepdims=True)
        ahead = np.where(speed > 0.01, shine.velocity / np.maximum(speed, 0.01), [1.0, 0.0, 0.0])
        N = len(shine)
        part = rng.uniform(-0.5, 0.5, N) if several else rng.normal(0.0, WANDERING, N)
        place = shine.position + (part * size[shine.id])[:, None] * ahead
        return replace(shine, position=place), np.full(N, 0.9 if several else 0.95)

    return echoes
