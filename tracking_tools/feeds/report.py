# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What one report says of one contact, whatever the format that it came in."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tracking_core.batches import Floats

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
    track: int | None = None  # number that the sender gives
    second: float = np.nan  # of the minute, where that is all that is told of the time [s]
    elevation: float = np.nan  # [rad], NaN: not told, as its sd
    elevation_sd: float = np.nan  # [rad]
    sent: float = np.nan  # by whoever recorded or passed it on, since the epoch [s]


def polar_of(
    latitude: float, longitude: float, origin: tuple[float, float]
) -> tuple[float, float]:
    """
    Return range [m] and azimuth [rad] of a place at sea level, as a radar at the origin has them.

    The range is straight, at 80 km half a metre less than over the ground; the azimuth counts from
    the east of the origin, wherever meridians meet.

    Parameters
    ----------
    latitude, longitude : float
        WGS 84 [deg].
    origin : tuple of float
        The same of the origin.

    """
    line = _from_centre(latitude, longitude) - _from_centre(*origin)
    cos, sin = np.cos(np.radians(origin)), np.sin(np.radians(origin))
    outward = cos[1] * line[0] + sin[1] * line[1]  # from the axis of the earth
    east = cos[1] * line[1] - sin[1] * line[0]
    north = cos[0] * line[2] - sin[0] * outward
    return float(np.linalg.norm(line)), float(np.arctan2(north, east))


def _from_centre(latitude: float, longitude: float) -> Floats:
    """Return a place on the ellipsoid (3,) from the centre of the earth [m]."""
    cos, sin = np.cos(np.radians([latitude, longitude])), np.sin(np.radians([latitude, longitude]))
    flat = (1.0 - FLATTENING) ** 2
    curved = EQUATOR / np.sqrt(cos[0] ** 2 + flat * sin[0] ** 2)  # radius, from east to west
    return np.asarray(curved * np.array([cos[0] * cos[1], cos[0] * sin[1], flat * sin[0]]))
