# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are drones, an airport's surface, people and cars tracked with defaults, and with presets?

Run ``python -m benchmarks.near_radars [--runs N] [--only SCENE ...] [--first SEED]``. All of it is
simulated; the figures of the radars are within those of public data sheets, which
``docs/results/near_radars.md`` names. Presets were chosen on seeds 0 to 4.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from benchmarks.airport import airport
from benchmarks.real_data import PROJECT
from benchmarks.scene_figures import Figures, HEAD, judge, line, play
from benchmarks.simulated_scene import Scene
from benchmarks.wanderers import BIRD, CAR, DRONE, inside, Kind, PERSON, ROBOT, wander, within
from benchmarks.watched_scene import Echoes, watched
from tracking_core.batches import Floats
from tracking_tools.parameter_file import parse_value, read_parameter_file
from tracking_tools.scenarios.passes import TrueStates
from tracking_tools.scenarios.radar import SimulatedRadar

FIRST = 100  # seeds below were looked at while presets were chosen
Counts = Sequence[tuple[Kind, int]]
AHEAD = (-1.05, 2.1)  # sector of what stares: begin and width [rad]
TURNING = SimulatedRadar(
    1.0, 4.0, 0.012, range_rate_sd=0.5, detection_probability=0.8, clutter_per_turn=15.0,
    rotation='anticlockwise', azimuth_start=0.0, range_limits=(50.0, 3000.0),
    range_rate_limit=30.0,
)  # fmt: skip
STARING = SimulatedRadar(
    0.2, 1.5, 0.017, range_rate_sd=0.3, detection_probability=0.85, clutter_per_turn=8.0,
    rotation='staring', range_limits=(20.0, 1000.0), azimuth_coverage=AHEAD, range_rate_limit=30.0,
)  # fmt: skip
PANEL = SimulatedRadar(
    0.5, 3.0, 0.02, elevation_sd=0.03, detection_probability=0.8, clutter_per_turn=10.0,
    rotation='staring', range_limits=(20.0, 2000.0), azimuth_coverage=AHEAD,
    elevation_limits=(-0.1, 0.6),
)  # fmt: skip
PEOPLE = SimulatedRadar(
    0.05, 0.15, 0.02, range_rate_sd=0.15, detection_probability=0.85, clutter_per_turn=2.0,
    rotation='staring', range_limits=(1.0, 50.0), azimuth_coverage=AHEAD, range_rate_limit=10.0,
)  # fmt: skip
CARS = SimulatedRadar(
    0.072, 0.3, 0.01, range_rate_sd=0.1, detection_probability=0.85, clutter_per_turn=3.0,
    rotation='staring', range_limits=(3.0, 150.0), azimuth_coverage=AHEAD, range_rate_limit=40.0,
)  # fmt: skip
OBJECTS = SimulatedRadar(
    0.1, 0.2, 0.008, position_sd=0.25, detection_probability=0.9, clutter_per_turn=1.0,
    rotation='staring', range_limits=(1.0, 60.0), azimuth_coverage=AHEAD,
)  # fmt: skip


def crowd(
    seed: int, radar: SimulatedRadar, looks: int, counts: Counts, radius: float,
    notch: tuple[float, float] | None = None, square: tuple[float, float] | None = None,
) -> Scene:  # fmt: skip
    """
    Return contacts that wander.

    Parameters
    ----------
    seed : int
        Of all chance.
    radar : SimulatedRadar
        That sees them.
    looks : int
        How many.
    counts : sequence of (Kind, int)
        How many of which kind.
    radius : float
        Farther off, a track follows somebody else [m].
    notch : (float, float), optional
        Where the range changes by less than this [m/s], the chance of a plot.
    square : (float, float), optional
        All are in a square: distance of its middle, ahead, and half its side [m].

    """
    rng, far = np.random.default_rng(seed), radar.range_limits[1]
    half = 0.85 if radar.is_staring else np.pi
    anywhere = within(rng, 0.1 * far, 0.9 * far, half)
    if square is not None:
        anywhere = inside(rng, *square)
    kinds = [kind for kind, number in counts for _ in range(number)]
    paths = [wander(rng, kind, anywhere, looks * radar.period) for kind in kinds]
    return watched(rng, radar, paths, looks, radius, notched(radar, *notch) if notch else None)


def notched(radar: SimulatedRadar, slowest: float, chance: float) -> Echoes:
    """Return that contacts whose range hardly changes are seen with another chance."""

    def echoes(states: TrueStates) -> tuple[TrueStates, Floats]:
        line = states.position / np.linalg.norm(states.position, axis=1, keepdims=True)
        slow = np.abs((states.velocity * line).sum(axis=1)) < slowest
        return states, np.where(slow, chance, radar.detection_probability)

    return echoes


FEW = ((DRONE, 6), (BIRD, 6), (PERSON, 3))
DENSE, RAIN = replace(STARING, clutter_per_turn=40.0), replace(TURNING, clutter_per_turn=60.0)
PLACES = replace(STARING, position_sd=10.0)
TURN = partial(crowd, looks=120, counts=FEW, radius=120.0)
STARE = partial(crowd, looks=300, counts=FEW, radius=60.0)
WALK = partial(crowd, radar=PEOPLE, looks=400)
# Each scene, and the presets that are tried besides the defaults.
DRONES, AIRPORT, NEAR = (
    ('marine_radar', 'drone_radar'), ('air_approach_2d', 'surface_movement_radar'),
    ('harbour_radar', 'short_range_radar'),
)  # fmt: skip
CASES: dict[str, tuple[Callable[[int], Scene], tuple[str, ...]]] = {
    'drones, turning': (partial(TURN, radar=TURNING, notch=(0.3, 0.4)), DRONES),
    'drones, turning, 60 false plots': (partial(TURN, radar=RAIN, notch=(0.3, 0.4)), DRONES),
    'drones, turning, hovering unseen': (partial(TURN, radar=TURNING, notch=(0.5, 0.05)), DRONES),
    'drones, staring': (partial(STARE, radar=STARING, notch=(0.2, 0.4)), DRONES),
    'drones, staring, 40 false plots': (partial(STARE, radar=DENSE, notch=(0.2, 0.4)), DRONES),
    'drones, staring, in x and y': (partial(STARE, radar=PLACES, notch=(0.2, 0.4)), DRONES),
    'drones, swarm of 8 in 120 m': (
        partial(STARE, radar=STARING, counts=((DRONE, 8),), square=(600.0, 60.0)), DRONES),
    'drones, 3-D without Doppler': (
        partial(crowd, radar=PANEL, looks=200, counts=((DRONE, 6), (BIRD, 6)), radius=150.0),
        ('air_surveillance_3d', 'drone_radar')),
    'airport': (airport, AIRPORT),
    'airport, queue': (partial(airport, queue=True), AIRPORT),
    'airport, several plots': (
        partial(airport, several=True),
        (*AIRPORT, 'surface_movement_radar sensor.contact_size=40')),
    'near, people and robots': (
        partial(WALK, counts=((PERSON, 6), (ROBOT, 2)), radius=3.0), NEAR),
    'near, crowd of 8 in 12 m': (
        partial(WALK, counts=((PERSON, 8),), radius=1.5, square=(25.0, 6.0)), NEAR),
    'near, cars and people': (
        partial(crowd, radar=CARS, looks=350, counts=((CAR, 6), (PERSON, 4)), radius=6.0), NEAR),
    'near, objects in x and y': (
        partial(crowd, radar=OBJECTS, looks=300, counts=((ROBOT, 4), (PERSON, 3)), radius=3.0),
        NEAR),
}  # fmt: skip


def run(name: str, given: str, seed: int) -> Figures:
    """Return the figures of a scene with a preset and what is set besides, '': the defaults."""
    scene, words = CASES[name][0](seed), given.split()
    values: dict[str, Any] = {}
    if words:
        path = PROJECT / 'config' / f'{words[0]}.yaml'
        values = read_parameter_file(path, '/radar_tracker')
    own = {k: parse_value(v) for k, v in (word.split('=') for word in words[1:])}
    return judge(scene, *play(scene, {**values, **own}))[0]


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='Radars that see near, with and without preset.')
    parser.add_argument('--runs', type=int, default=12, help='of each row')
    parser.add_argument('--first', type=int, default=FIRST, help='seed of the first run')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    parser.add_argument('--only', nargs='*', default=[''], help='scenes that begin so')
    given = parser.parse_args(arguments)
    print(HEAD)
    with ProcessPoolExecutor(given.jobs) as pool:
        for name, (_, presets) in CASES.items():
            for preset in ('', *presets) if name.startswith(tuple(given.only)) else ():
                seeds = range(given.first, given.first + given.runs)
                figures = list(pool.map(partial(run, name, preset), seeds))
                print(line(f'{name}, {preset or "defaults"}', figures), flush=True)


if __name__ == '__main__':
    main()
