# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which scenes for a sonar are fixed to the last figure."""

from __future__ import annotations

import math

from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.listening import Watch
from tracking_tools.scenarios.passes import Contact

KNOT = 1852.0 / 3600.0  # [m/s]
NORTH = math.pi / 2.0


def ship(bearing: float, distance: float, course: float, speed: float) -> Legs:
    """Return a ship on a straight course; angles from north clockwise [deg], [m], [kn]."""
    direction = NORTH - math.radians(bearing)
    position = (distance * math.cos(direction), distance * math.sin(direction), 0.0)
    return Legs(position, speed * KNOT, NORTH - math.radians(course))


def v0() -> Watch:
    """V-0 of [VORONINA19], NOMINAL: two contacts cross, heard as one for ten minutes."""
    contacts = (Contact(1, ship(117.0, 5000.0, 0.0, 10.0)),
                Contact(2, ship(109.0, 6000.0, 0.0, 10.0)))  # fmt: skip
    own = ship(0.0, 0.0, 0.0, 5.0)
    return Watch(own, contacts, (0.0, -4.0), 1850.0, 'V-0 of [VORONINA19], two contacts cross')


def long_watch() -> Watch:
    """V-0, another two contacts, and a turn of own ship after which ranges can be known."""
    scene, turn_rate = v0(), math.radians(0.8)
    own = Legs(
        (0.0, 0.0, 0.0),
        5.0 * KNOT,
        NORTH,
        (Leg(1900.0), Leg(math.radians(60.0) / turn_rate, turn_rate)),
    )
    others = (
        Contact(3, ship(36.0, 6500.0, 5.0, 7.0)),
        Contact(4, ship(148.0, 5500.0, 0.0, 6.5), 240.0, 1500.0),
    )
    levels = (*scene.levels, 1.0, -1.0)
    return Watch(
        own, scene.contacts + others, levels, 2700.0,
        'four contacts, two of them crossing as in V-0 of [VORONINA19], one that falls silent',
    )  # fmt: skip
