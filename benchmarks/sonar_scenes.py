# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which scenes are like the recorded vessels, but fresh? Simulated traffic off a harbour."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from benchmarks.sonar_recordings import by_cycle, cycles_of, DEGREE, own_ship, Record
from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios.legs import Leg, Legs

PERIOD = 10.0  # of a cycle [s]
DURATION = 3600.0  # [s]
CONTACTS = 8
PAUSE = 1200.0  # longest pause of own ship's data [s]
BEARING_SD = 1.0 * DEGREE
FALSE_MARKS = 2.0  # a cycle
HARBOUR = (6000.0, 1500.0)  # distance of the harbour from own ship, sd of the traffic off it [m]
LOUD, FAINT, SILENT = 8000.0, 12000.0, 12000.0  # P_D 0.9 until, falling to 0.6 at, and beyond [m]


@dataclass(frozen=True)
class Habits:
    """How a kind of vessel moves: stretches of it are drawn one by one."""

    speed: tuple[float, float]  # lowest and highest when under way [m/s]
    rest: float  # share of the stretches that are spent at rest
    stretch: float  # mean length of a stretch [s]
    turn: float  # sd of the change of course from stretch to stretch [rad]
    acceleration: float = 0.05  # [m/s^2]
    turn_rate: float = 0.02  # [rad/s]


TRAFFIC = Habits((1.0, 7.0), 0.5, 600.0, 1.0)
FAST_OWN = Habits((3.0, 13.0), 0.4, 300.0, 1.2, acceleration=0.1)
SLOW_OWN = Habits((4.5, 5.5), 0.2, 1200.0, 0.8)


def journey(habits: Habits, place: Floats, rng: np.random.Generator) -> Legs:
    """Return how a vessel moves that is at a place (2,) [m] at the start."""
    legs: list[Leg] = []
    first = speed = 0.0 if rng.random() < habits.rest else rng.uniform(*habits.speed)
    while sum(leg.duration for leg in legs) < DURATION + PAUSE:
        legs.append(Leg(rng.exponential(habits.stretch) + 1.0))
        wanted = 0.0 if rng.random() < habits.rest else rng.uniform(*habits.speed)
        angle = habits.turn * rng.standard_normal()
        if speed > 0.0:
            legs.append(Leg(abs(angle) / habits.turn_rate, np.sign(angle) * habits.turn_rate))
        if wanted != speed:
            time = abs(wanted - speed) / habits.acceleration
            legs.append(Leg(time, acceleration=(wanted - speed) / time))
        speed = wanted
    x, y = place.tolist()
    return Legs((x, y, 0.0), first, rng.uniform(-np.pi, np.pi), tuple(legs))


def sea(seed: int) -> Record:
    """
    Return an hour of bearings of eight vessels off a harbour.

    Own ship is fast in every other scene, and in every other pair its data pause once.
    """
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, DURATION, PERIOD)
    if seed // 2 % 2:
        pause = rng.uniform(0.25, 1.0) * PAUSE
        time = time + pause * (time >= rng.uniform(0.3, 0.8) * DURATION)
    own = journey((SLOW_OWN, FAST_OWN)[seed % 2], np.zeros(2), rng).at(time)[0][:, :2]
    angle = rng.uniform(-np.pi, np.pi)
    harbour = HARBOUR[0] * np.array([np.cos(angle), np.sin(angle)])
    paths = [
        journey(TRAFFIC, harbour + HARBOUR[1] * rng.standard_normal(2), rng).at(time)[0][:, :2]
        for _ in range(CONTACTS)
    ]
    line = np.stack(paths, axis=1) - own[:, None]
    distance = np.hypot(line[..., 0], line[..., 1])
    row, contact = np.nonzero(distance < SILENT)
    x, y = line[row, contact].T
    record = Record(
        f'scene {seed}', cycles_of(time, np.zeros(0, np.int64), np.zeros(0)), own_ship(time, own),
        row, contact, np.arctan2(y, x), distance[row, contact], 3.0 * DEGREE, 8000.0,
    )  # fmt: skip
    return heard(record, rng)


def heard(record: Record, rng: np.random.Generator) -> Record:
    """Return the record with marks drawn anew: the same movements, heard once more."""
    time = np.array([cycle.stamp for cycle in record.cycles])
    chance = np.interp(record.distance, [LOUD, FAINT], [0.9, 0.6]) * (record.distance < SILENT)
    found = np.flatnonzero(rng.random(len(chance)) < chance)
    noisy = record.bearing[found] + BEARING_SD * rng.standard_normal(len(found))
    false = np.repeat(np.arange(len(time)), rng.poisson(FALSE_MARKS, len(time)))
    scan = np.concatenate([record.scan[found], false])
    mark = np.concatenate([wrap_angle(noisy), rng.uniform(-np.pi, np.pi, len(false))])
    source = np.concatenate([record.contact[found], np.full(len(false), -1)])
    order = rng.permutation(len(scan))  # marks of a cycle come in no order
    order = order[np.argsort(scan[order], kind='stable')]
    return replace(
        record,
        cycles=cycles_of(time, scan[order], mark[order]),
        source=by_cycle(len(time), scan[order], source[order]),
    )
