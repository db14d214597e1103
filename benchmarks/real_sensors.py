# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What do radars that are not as the textbook has them do to tracks?

Run ``python -m benchmarks.real_sensors [--runs N] [--only SCENE ...] [--set NAME=VALUE ...]``.
The scenes are in ``long_ships``, ``cars``, ``aircraft`` and ``disturbed_radar``. Mean and standard
error over the runs; what the columns are, ``scene_figures.Figures`` says. With ``--set`` each
scene is played once, with these values over its own.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any

from tqdm import tqdm

from benchmarks.aircraft import aircraft, by_range, with_notch
from benchmarks.cars import cars
from benchmarks.disturbed_radar import birds, second_time, STAGGER, strobe
from benchmarks.long_ships import ships
from benchmarks.scene_figures import Figures, HEAD, judge, line, play
from benchmarks.simulated_scene import Scene
from tracking_tools.parameter_file import parse_value

FIRST = 200  # seeds below were looked at while the map of clutter was made
Values = Mapping[str, Any]
NOTHING: Values = {}
SHIP, CAR = {'sensor.contact_size': 250}, {'sensor.contact_size': 4.5}
TWENTY, TEN = {'sensor.range_rate_interval': 40}, {'sensor.range_rate_interval': 20}
SLOWER = {'initiation.speed_sd': 12}
LOW, MANY = {'sensor.elevation_span': 0.3}, {'existence.new_contacts': 1000}
PATIENT = {'sensor.detection_probability': 0.4}
# Each scene, and what is set in turn.
CASES: dict[str, tuple[Callable[[int], Scene], tuple[Values, ...]]] = {
    'long ships': (ships, (NOTHING, SHIP)),
    'long ships, side lobes': (partial(ships, echoes='lobes'), (SHIP,)),
    'long ships, twice the range': (partial(ships, echoes='twice'), (SHIP,)),
    'cars, one plot': (cars, (NOTHING,)),
    'cars': (partial(cars, several=True), (NOTHING, CAR)),
    'cars, rails': (partial(cars, several=True, rails=True), (NOTHING, CAR)),
    'cars, one plot, rates to 20': (partial(cars, fold=20.0), (NOTHING, TWENTY)),
    'cars, one plot, rates to 10': (partial(cars, fold=10.0), (NOTHING, TEN)),
    'cars, rails, rates to 20': (
        partial(cars, several=True, rails=True, fold=20.0),
        ({**CAR, **TWENTY}, {**CAR, **TWENTY, **SLOWER}),
    ),
    'aircraft, P_D 0.9': (aircraft, (NOTHING,)),
    'aircraft, P_D 0.6': (partial(aircraft, chance=0.6), (NOTHING,)),
    'aircraft, P_D 0.4': (partial(aircraft, chance=0.4), (NOTHING,)),
    'aircraft, P_D 0.95 to 0.4': (partial(aircraft, chance=by_range), (NOTHING,)),
    'aircraft, notch': (partial(aircraft, chance=with_notch), (NOTHING, PATIENT)),
    'aircraft, 3 in 10 no height': (partial(aircraft, without_height=0.3), (NOTHING,)),
    'strobe': (strobe, (NOTHING, LOW)),
    'strobe, blanked': (partial(strobe, blanked=True), (NOTHING,)),
    'strobe, silent': (partial(strobe, amount=0.0), (NOTHING,)),
    'birds': (birds, (NOTHING, MANY)),
    'second time around': (second_time, (NOTHING,)),
    'second time around, leaps': (partial(second_time, stagger=STAGGER), (NOTHING,)),
}  # fmt: skip


def run(name: str, values: Values, seed: int) -> list[tuple[str, Figures]]:
    """Return the figures of each part of a scene."""
    scene = CASES[name][0](seed)
    parts = [part.name for part in scene.parts]
    return list(zip(parts, judge(scene, *play(scene, values)), strict=True))


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='Radars that are not as the textbook has them.')
    parser.add_argument('--runs', type=int, default=12, help='of each row')
    parser.add_argument('--first', type=int, default=FIRST, help='seed of the first run')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    parser.add_argument('--only', nargs='*', default=[''], help='scenes that begin so')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args(arguments)
    own = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    seeds = range(given.first, given.first + given.runs)
    print(HEAD)
    with ProcessPoolExecutor(given.jobs) as pool:
        for name, (_, variants) in CASES.items():
            if not name.startswith(tuple(given.only)):
                continue
            for values in (own,) if own else variants:
                title = ', '.join([name, *(f'`{k}: {v}`' for k, v in values.items())])
                found = pool.map(partial(run, name, values), seeds)
                runs = list(tqdm(found, total=given.runs, desc=title, leave=False))
                for part in zip(*runs, strict=True):
                    label = f'{title}: {part[0][0]}' if part[0][0] else title
                    print(line(label, [figures for _, figures in part]), flush=True)


if __name__ == '__main__':
    main()
