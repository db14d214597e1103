# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Synthetic traffic around an airport: holding patterns, arrivals, departures."""

from __future__ import annotations

import math

from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.passes import Contact
from tracking_tools.scenarios.plots import Scenario
from tracking_tools.scenarios.radar import SimulatedRadar


def terminal() -> Scenario:
    """Two stacks of holdings, arrivals that leave them one by one, departures climbing out."""
    contacts = [
        Contact(
            10 * stack + level,
            _holding((x, y, 2_400.0 + 300.0 * level), math.radians(course), rounds=level),
        )
        for stack, (x, y, course) in enumerate(
            ((-22_000.0, 18_000.0, 300.0), (25_000.0, -14_000.0, 140.0)), start=1
        )
        for level in range(1, 5)
    ]
    contacts += [
        Contact(30 + k, _departure(math.radians(40.0 + 85.0 * k)), appear=150.0 * k)
        for k in range(4)
    ]
    radar = SimulatedRadar(
        period=4.0,
        range_sd=50.0,
        azimuth_sd=math.radians(0.1),
        elevation_sd=math.radians(0.15),
        clutter_per_turn=25.0,
        range_limits=(1_000.0, 80_000.0),
        elevation_limits=(0.0, math.radians(40.0)),
    )
    return Scenario(radar, tuple(contacts), 1_500.0, 'holding patterns, arrivals and departures')


def racetrack(
    place: tuple[float, float, float], course: float, speed: float, rounds: int = 12
) -> Legs:
    """Fly a holding pattern: a minute straight, half a turn right at 3 deg/s, and so on."""
    half = (Leg(60.0), Leg(60.0, turn_rate=math.radians(-3.0)))
    return Legs(place, speed, course, half * 2 * rounds)


def _holding(place: tuple[float, float, float], course: float, rounds: int) -> Legs:
    """Fly some rounds of a holding 1000 ft above the next, then down towards the field."""
    pattern = racetrack(place, course, 110.0, rounds).legs
    descent = (
        Leg(60.0, climb_rate=-6.0, acceleration=-0.4),
        Leg(120.0),
        Leg(60.0, turn_rate=math.radians(1.5)),
        Leg(200.0, climb_rate=0.0),
    )
    return Legs(place, 110.0, course, (*pattern, *descent))


def _departure(course: float) -> Legs:
    """Climb out, speed up, one turn on the way."""
    legs = (
        Leg(60.0, acceleration=0.8, climb_rate=10.0),
        Leg(30.0, turn_rate=math.radians(2.0)),
        Leg(200.0, acceleration=0.3),
        Leg(45.0, turn_rate=math.radians(-1.0)),
        Leg(300.0, climb_rate=4.0),
    )
    start = (3_000.0 * math.cos(course), 3_000.0 * math.sin(course), 300.0)
    return Legs(start, 80.0, course, legs)
