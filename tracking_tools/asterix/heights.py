# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How high above the horizon is a plot that tells its height above the sea?

Without that an aircraft stands at its slant range, at 10 km height in 20 km range 2.7 km too far.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tracking_tools.asterix.items import number, part, quantity

EARTH = 6_371_000.0  # m, mean radius
FLIGHT_LEVEL, FOOT = 30.48, 0.3048  # m
LEVEL_SD = 20.0  # of flight levels, in steps of 25 or 100 feet [m]


def elevation_of(record: Any, distance: float, site: float | None) -> tuple[float, float]:
    """
    Return elevation and its sd [rad], both NaN where no height that can be true is told.

    Parameters
    ----------
    record : Record
        Of CAT048. Its flight level counts (090) if it is validated and not garbled, else the
        height that a 3-D radar measured (110), whose noise it does not tell.
    distance : float
        Slant range [m].
    site : float
        Height of the radar above the sea [m]; None: not known.

    """
    if site is None:
        return np.nan, np.nan
    level, measured = record.get_item('090'), record.get_item('110')
    if level is not None and not (number(level, 'V') or number(level, 'G')):
        height, sd = quantity(part(level, 'FL'), 'FL') * FLIGHT_LEVEL, LEVEL_SD
    elif measured is not None:
        height, sd = quantity(part(measured, '3DH'), 'ft') * FOOT, np.nan
    else:
        return np.nan, np.nan
    # The cosine rule at the centre of the earth; rays bend so little that their length stays.
    centre, above = EARTH + site, height - site
    rise = (above * (2.0 * centre + above) - distance**2) / (2.0 * centre)  # in the radar's axes
    if abs(rise) >= distance:
        return np.nan, np.nan
    return float(np.arcsin(rise / distance)), sd / float(np.sqrt(distance**2 - rise**2))
