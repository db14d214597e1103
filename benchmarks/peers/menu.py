# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which scenes are raced on: en-route traffic, formations, crossings, a manoeuvre, bearings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
import math

import numpy as np

from benchmarks.peers.scenes import Knowledge, measured, observe, Scene
from tracking_core.motion import ConstantVelocity, RandomWalk
from tracking_tools.scenarios import build, Contact
from tracking_tools.scenarios.studies import two_mode_path
from tracking_tools.scenarios.traffic import en_route

SPACING = 15_000.0  # an aircraft en route on each square of this size [m]
ABREAST = 400.0  # of aircraft in formation [m]
FLIGHT = Knowledge(
    period=8.0,
    noise=100.0,
    detection_probability=0.9,
    clutter_density=0.3 / SPACING**2,
    region=50_000.0,
    modes=(ConstantVelocity(1.0), ConstantVelocity(8.0)),
    sojourn=(200.0, 25.0),
    single=ConstantVelocity(3.0),
    speed_sd=150.0,
    speed_max=300.0,
    arrivals=60.0,
    cutoff=1000.0,
)
_NEAR = replace(
    FLIGHT, period=4.0, clutter_density=2e-9, modes=(ConstantVelocity(0.5), ConstantVelocity(5.0)),
    sojourn=(100.0, 25.0), single=ConstantVelocity(3.0),
)  # fmt: skip
_DEGREE = math.radians(1.0)
LISTENING = Knowledge(
    period=10.0,
    noise=0.5 * _DEGREE,
    detection_probability=0.85,
    clutter_density=1.0,
    region=1.5,
    modes=(RandomWalk(1e-4, 3e-6), RandomWalk(1e-4, 1e-4)),
    sojourn=(600.0, 60.0),
    single=RandomWalk(1e-4, 3e-5),
    speed_sd=1e-3,
    speed_max=5e-3,
    arrivals=60.0,
    cutoff=5.0 * _DEGREE,
)


def traffic(count: int, scans: int, seed: int) -> Scene:
    """Return aircraft that enter, turn now and then, and leave: so many at a time."""
    radius = SPACING * math.sqrt(count / math.pi)
    outer = radius + 260.0 * FLIGHT.period * scans
    contacts = en_route(round(count * (outer / radius) ** 2)).contacts
    stay = 0.5 * math.pi * radius / 220.0  # mean time across the disc [s]
    knowledge = replace(FLIGHT, region=radius, arrivals=3600.0 * count / stay)
    return observe(f'en route, {count}', knowledge, contacts, scans, seed)


def formations(scans: int, seed: int) -> Scene:
    """Return ten times four aircraft, `ABREAST` apart, that turn together and break away."""
    contacts = _spread(build('formation').contacts, 10, 60_000.0)
    knowledge = replace(_NEAR, region=200_000.0, clutter_density=2e-10)
    return observe('formations', knowledge, contacts, scans, seed)


def large_formations(scans: int, seed: int) -> Scene:
    """Return twice sixteen aircraft that fly and turn as `formations` do."""
    four = build('formation').contacts
    contacts = _spread(_spread(four, 4, 2.0 * ABREAST), 2, 60_000.0)
    knowledge = replace(_NEAR, region=200_000.0, clutter_density=2e-10)
    return observe('large formations', knowledge, contacts, scans, seed)


def crossings(scans: int, seed: int) -> Scene:
    """Return four pairs of aircraft that cross while they turn."""
    knowledge = replace(_NEAR, period=5.0, region=100_000.0, clutter_density=1e-9)
    contacts = _spread(build('crossing').contacts, 4, 60_000.0)
    return observe('crossings', knowledge, contacts, scans, seed)


def manoeuvre(scans: int, seed: int) -> Scene:
    """Return one aircraft that turns gently, then hard."""
    knowledge = replace(_NEAR, period=5.0, region=40_000.0)
    return observe('one that turns', knowledge, (Contact(1, two_mode_path()),), scans, seed)


def listening(scans: int, seed: int) -> Scene:
    """Return six vessels heard by a sonar that stands still; bearings cross and pass slowly."""
    time = LISTENING.period * np.arange(scans)
    place = 1_000.0 * np.array([[4, -3], [5, 2], [6, 4], [9, -6], [8, 1], [3, 3]], float)
    speed = np.array([[-2, 6], [-3, -5], [-6, -1], [1, 9], [-4, 3], [2, -8]], float)
    line = place[:, None] + speed[:, None] * time[:, None]  # (N, K, 2)
    x, y = line[..., 0], line[..., 1]
    vx, vy = np.moveaxis(np.broadcast_to(speed[:, None], line.shape), -1, 0)
    bearing, rate = np.arctan2(y, x), (x * vy - y * vx) / (x**2 + y**2)
    inside = np.abs(bearing) < LISTENING.region
    return measured(
        'sonar bearings', LISTENING, bearing[..., None], rate[..., None], inside, seed
    )  # fmt: skip


def _spread(contacts: tuple[Contact, ...], copies: int, spacing: float) -> tuple[Contact, ...]:
    """Return copies of the contacts side by side, each with ids of its own."""
    side = math.ceil(math.sqrt(copies))
    moved = []
    for copy in range(copies):
        shift = [spacing * (copy % side - 0.5 * side + 0.5),
                 spacing * (copy // side - 0.5 * side + 0.5), 0.0]  # fmt: skip
        for contact in contacts:
            path = contact.trajectory
            place = tuple(float(a + b) for a, b in zip(path.position, shift, strict=True))
            moved.append(Contact(len(moved) + 1, replace(path, position=place)))
    return tuple(moved)


@dataclass(frozen=True)
class Entry:
    """A scene of the menu."""

    make: Callable[[int, int], Scene]  # from scans and seed
    scans: int
    runs: int
    when_asked: bool = False  # by name only: takes some of the others too long


MENU = {
    'en_route_10': Entry(partial(traffic, 10), 40, 6),
    'en_route_50': Entry(partial(traffic, 50), 40, 3),
    'en_route_200': Entry(partial(traffic, 200), 16, 2),
    'en_route_1000': Entry(partial(traffic, 1000), 10, 1),
    'formations': Entry(formations, 90, 2),
    'large_formations': Entry(large_formations, 50, 2, when_asked=True),
    'crossings': Entry(crossings, 100, 4),
    'one_that_turns': Entry(manoeuvre, 100, 8),
    'sonar': Entry(listening, 120, 6),
}
