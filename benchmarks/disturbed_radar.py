# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Aircraft among what disturbs a radar: a jammer's strobe, birds, echoes of an earlier pulse."""

from __future__ import annotations

import numpy as np

from benchmarks.aircraft import (
    AIRCRAFT,
    even,
    FARTHEST,
    HIGHEST,
    polar_of,
    RADAR,
    scene,
    SD,
    seen,
    traffic,
    TURN_TIME,
    TURNS,
    within,
)
from benchmarks.simulated_scene import antenna, Part, passes, Rng, Scene, times_of
from tracking_core.batches import Bools, Floats
from tracking_tools.scenarios.legs import Legs

STROBE = (1.5, np.radians(10.0))  # where, and how wide [rad]
JAMMED = (40, 48)  # first and last turn, exclusive: 32 s
IN_STROBE = 6  # aircraft that are there then
BIRDS, SWARM = 50, (12e3, 9e3, 3e3)  # middle and half the side of their square [m]
FAR = 6  # aircraft beyond the radar's range
STAGGER = 6e3  # of the unambiguous range, from turn to turn [m]


def strobe(seed: int, amount: float = 300.0, blanked: bool = False) -> Scene:
    """
    Return six minutes with a jammer for half a minute.

    Parameters
    ----------
    seed : int
        Of all chance.
    amount : float
        Mean number of the jammer's plots in a turn.
    blanked : bool
        The radar gives no plots at all from the strobe meanwhile, as some do.

    """
    rng, turns = np.random.default_rng(seed), 90
    paths = traffic(rng, AIRCRAFT - IN_STROBE) + [_crossing(rng) for _ in range(IN_STROBE)]
    states = passes(RADAR, paths, turns)
    polar, time = seen(rng, states, even(0.9))
    number = rng.poisson(amount, JAMMED[1] - JAMMED[0])
    azimuth = STROBE[0] + rng.uniform(-0.5, 0.5, number.sum()) * STROBE[1]
    noise = np.column_stack([
        rng.uniform(2e3, FARTHEST, len(azimuth)), azimuth,
        rng.uniform(0.0, 0.5 * HIGHEST, len(azimuth)),
    ])  # fmt: skip
    jam = times_of(azimuth, np.repeat(np.arange(*JAMMED), number), TURN_TIME)
    if blanked:
        lost = _is_in(polar) & (time >= JAMMED[0] * TURN_TIME) & (time < JAMMED[1] * TURN_TIME)
        polar, time, noise, jam = polar[~lost], time[~lost], noise[:0], jam[:0]
    inside, during, after = within(*STROBE), JAMMED, (JAMMED[1], None)
    parts = (
        Part('before', (0, JAMMED[0])),
        Part('during, in it', during, inside=inside),
        Part('during, outside', during, inside=lambda place: ~inside(place)),
        Part('after, in it', after, inside=inside),
        Part('after, outside', after, inside=lambda place: ~inside(place)),
    )
    return scene(rng, states, AIRCRAFT, [(polar, time), (noise, jam)], parts, turns)


def _crossing(rng: Rng) -> Legs:
    """Return an aircraft that is in the strobe in the middle of its time."""
    azimuth = STROBE[0] + rng.uniform(-0.4, 0.4) * STROBE[1]
    distance, speed = rng.uniform(20e3, 100e3), rng.uniform(80.0, 200.0)
    place = (distance * np.cos(azimuth), distance * np.sin(azimuth), rng.uniform(2500.0, 10e3))
    middle = 0.5 * sum(JAMMED) * TURN_TIME
    return Legs(place, speed, rng.uniform(-np.pi, np.pi), start=middle)


def _is_in(polar: Floats) -> Bools:
    off = (polar[:, 1] - STROBE[0] + np.pi) % (2.0 * np.pi) - np.pi
    return np.asarray(np.abs(off) < 0.5 * STROBE[1])


def birds(seed: int) -> Scene:
    """Return aircraft, and birds 850 m apart at 15 m/s, which are contacts as any other."""
    rng = np.random.default_rng(seed)
    middle, half = np.array(SWARM[:2]), SWARM[2]
    course, paths = rng.uniform(-np.pi, np.pi), traffic(rng)
    for place in middle + rng.uniform(-half, half, (BIRDS, 2)):
        height, speed = rng.uniform(200.0, 800.0), rng.uniform(13.0, 17.0)
        paths.append(Legs((*place, height), speed, course + rng.normal(0.0, 0.1)))
    states = passes(RADAR, paths, TURNS)
    is_bird = states.id >= AIRCRAFT
    plots = seen(rng, states, lambda s: np.where(is_bird, 0.7, 0.9))

    parts = (
        Part('birds', contacts=(AIRCRAFT, None)),
        Part('aircraft', contacts=(0, AIRCRAFT)),
    )
    return scene(rng, states, AIRCRAFT + BIRDS, [plots], parts)


def second_time(seed: int, stagger: float = 0.0) -> Scene:
    """
    Return aircraft, and six beyond the range whose echoes come after the next pulse.

    They are seen too near, by the unambiguous range; where that changes by `stagger` from turn
    to turn [m], they leap.
    """
    rng = np.random.default_rng(seed)
    states = passes(RADAR, traffic(rng), TURNS)
    beyond = []
    for _ in range(FAR):
        azimuth, distance = rng.uniform(-np.pi, np.pi), rng.uniform(1.2, 1.7) * FARTHEST
        place = (distance * np.cos(azimuth), distance * np.sin(azimuth), 10e3)
        beyond.append(Legs(place, rng.uniform(180.0, 260.0), rng.uniform(-np.pi, np.pi)))
    far = passes(antenna(TURN_TIME, 2.0 * FARTHEST, SD), beyond, TURNS)
    hit = rng.random(len(far)) < 0.8
    polar, time = polar_of(far.position[hit]), far.time[hit]
    polar[:, 0] -= FARTHEST + stagger * (time // TURN_TIME % 2)
    polar += SD * rng.standard_normal(polar.shape)
    ghost = (polar[:, 0] > 2e3) & (polar[:, 0] < FARTHEST)
    plots = [seen(rng, states, even(0.9)), (polar[ghost], time[ghost])]
    return scene(rng, states, AIRCRAFT, plots)
