# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What one report says of one contact, whatever the format that it came in."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

NAUTICAL_MILE = 1852.0  # m
EQUATOR, FLATTENING = 6_378_137.0, 1.0 / 298.257223563  # of WGS 84; radius [m]


class Report(NamedTuple):
    """One report; angles anticlockwise from east."""

    source: tuple[int, int] | str  # who sent it: SAC and SIC, a talker
    time_of_day: float = np.nan  # UTC [s], NaN: not told
    range: float = np.nan  # [m], NaN: not a plot but a mark of the antenna
    azimuth: float = np.nan  # [rad]
    doppler: float = np.nan  # as sent [m/s]
    amplitude: float = np.nan  # [dBm]
    track: int = 0  # number that the sender gives, 0: none
    second: float = np.nan  # of the minute, where that is all that is told of the time [s]


def polar_of(
    latitude: float, longitude: float, origin: tuple[float, float]
) -> tuple[float, float]:
    """
    Return range [m] and azimuth [rad] of a place seen from the origin, on a plane about it.

    Parameters
    ----------
    latitude, longitude : float
        WGS 84 [deg].
    origin : tuple of float
        The same of the origin.

    """
    sine = np.sin(np.radians(origin[0]))
    squashed = 1.0 - FLATTENING * (2.0 - FLATTENING) * sine**2
    across = EQUATOR / np.sqrt(squashed)  # radii of curvature [m]
    along = across * (1.0 - FLATTENING) ** 2 / squashed
    turn = (longitude - origin[1] + 180.0) % 360.0 - 180.0
    east = across * np.cos(np.radians(origin[0])) * np.radians(turn)
    north = along * np.radians(latitude - origin[0])
    return float(np.hypot(east, north)), float(np.arctan2(north, east))
