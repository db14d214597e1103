# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Synthetic traffic around a turning radar: en route, in formation, turning, at the seam."""

from __future__ import annotations

import math

import numpy as np

from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.passes import Contact
from tracking_tools.scenarios.plots import Scenario
from tracking_tools.scenarios.radar import NORTH, SimulatedRadar
from tracking_tools.scenarios.terminal import racetrack

_EN_ROUTE_SEED = 20_240_523
# One aircraft on each square of this size, however many there are [m].
_EN_ROUTE_SPACING = 15_000.0
_EN_ROUTE_FALSE_PLOTS_EACH = 0.3
_EN_ROUTE_LATEST = 2_000.0
# Faster turns are flown slowly: about 1 g across the course at most.
_TIGHT_TURN = 4.0


def en_route(count: int = 60, duration: float = 900.0) -> Scenario:
    """
    Aircraft crossing a disc at constant density, some of them turning now and then.

    Parameters
    ----------
    count : int
        Aircraft in the disc at the beginning.
    duration : float
        [s].

    Returns
    -------
    Scenario
        Contacts that leave the disc leave the radar's range.

    """
    rng = np.random.default_rng(_EN_ROUTE_SEED)
    radius = _EN_ROUTE_SPACING * math.sqrt(count / math.pi)
    distance = np.maximum(radius * np.sqrt(rng.random(count)), 2_000.0)
    angle, course = rng.uniform(-math.pi, math.pi, (2, count))
    speed = rng.uniform(180.0, 260.0, count)
    x, y = distance * np.cos(angle), distance * np.sin(angle)
    contacts = tuple(
        Contact(
            k + 1,
            Legs((float(x[k]), float(y[k]), 0.0), float(speed[k]), float(course[k]), _turns(rng)),
        )
        for k in range(count)
    )
    radar = SimulatedRadar(
        period=8.0,
        range_sd=60.0,
        azimuth_sd=math.radians(0.1),
        clutter_per_turn=_EN_ROUTE_FALSE_PLOTS_EACH * count,
        range_limits=(1_000.0, radius + 5_000.0),
    )
    return Scenario(radar, contacts, duration, f'{count} aircraft en route, constant density')


def _turns(rng: np.random.Generator) -> tuple[Leg, ...]:
    """Straight for minutes, a turn of up to 60 degrees, straight again, until it is late."""
    legs: list[Leg] = []
    while sum(leg.duration for leg in legs) < _EN_ROUTE_LATEST:
        rate = math.radians(rng.choice([-3.0, -1.5, -1.0, 1.0, 1.5, 3.0]))
        angle = math.radians(rng.uniform(10.0, 60.0))
        legs += [Leg(rng.uniform(100.0, 500.0)), Leg(angle / abs(rate), turn_rate=rate)]
    return tuple(legs)


def formation() -> Scenario:
    """Four aircraft 400 m apart turn together, then break away; plots close by merge."""
    together = (Leg(120.0), Leg(60.0, turn_rate=math.radians(1.5)), Leg(120.0))
    breaks = (-3.0, -1.0, 1.0, 3.0)
    contacts = tuple(
        Contact(
            k + 1,
            Legs(
                (-30_000.0 - 400.0 * (k % 2), 15_000.0 + 400.0 * (k // 2), 0.0),
                speed=200.0,
                course=0.0,
                legs=(*together, Leg(20.0, turn_rate=math.radians(rate)), Leg(160.0)),
            ),
        )
        for k, rate in enumerate(breaks)
    )
    radar = SimulatedRadar(
        period=4.0,
        range_sd=30.0,
        azimuth_sd=math.radians(0.08),
        clutter_per_turn=10.0,
        range_limits=(1_000.0, 60_000.0),
        range_resolution=150.0,
        azimuth_resolution=math.radians(1.2),
    )
    return Scenario(radar, contacts, 480.0, 'four aircraft in close formation that break away')


def turns() -> Scenario:
    """Six aircraft on six bearings, each with its own turn rate: 1 to 12 deg/s, left and right."""
    rates = (1.0, -2.0, 3.0, -5.0, 8.0, -12.0)
    contacts = tuple(_turner(k + 1, rate) for k, rate in enumerate(rates))
    radar = SimulatedRadar(
        period=4.0,
        range_sd=40.0,
        azimuth_sd=math.radians(0.08),
        clutter_per_turn=15.0,
        range_limits=(1_000.0, 70_000.0),
    )
    return Scenario(radar, contacts, 600.0, 'six aircraft turning at 1 to 12 deg/s')


def _turner(number: int, rate: float) -> Contact:
    """Half a turn, half a turn the other way, and a full circle."""
    bearing = math.radians(60.0 * number)
    place = (30_000.0 * math.cos(bearing), 30_000.0 * math.sin(bearing), 0.0)
    half = 180.0 / abs(rate)
    way = math.radians(rate)
    legs = (
        Leg(100.0),
        Leg(half, turn_rate=way),
        Leg(60.0),
        Leg(half, turn_rate=-way),
        Leg(60.0),
        Leg(2.0 * half, turn_rate=way),
    )
    speed = 60.0 if abs(rate) > _TIGHT_TURN else 150.0
    return Contact(number, Legs(place, speed, bearing + math.pi / 3, legs))


def seam() -> Scenario:
    """Aircraft around north, where one message ends and the next begins."""
    north = 25_000.0
    weave = tuple(Leg(20.0, turn_rate=math.radians(sign * 3.0)) for sign in (1, -1, -1, 1) * 8)
    contacts = (
        Contact(1, Legs((-12_000.0, north, 0.0), 120.0, 0.0)),
        Contact(2, Legs((12_000.0, north + 2_000.0, 0.0), 120.0, math.pi)),
        Contact(3, Legs((0.0, 70_000.0, 0.0), 150.0, -NORTH - math.radians(30.0), weave)),
        Contact(4, Legs((0.0, 15_000.0, 0.0), 150.0, NORTH - math.radians(30.0), weave)),
        Contact(5, racetrack((-1_500.0, 20_000.0, 0.0), 0.0, 110.0)),
        Contact(6, racetrack((1_500.0, 21_500.0, 0.0), math.pi, 110.0)),
    )
    radar = SimulatedRadar(
        period=4.0,
        range_sd=40.0,
        azimuth_sd=math.radians(0.1),
        clutter_per_turn=10.0,
        range_limits=(1_000.0, 80_000.0),
    )
    return Scenario(radar, contacts, 600.0, 'aircraft around north, where messages are cut')
