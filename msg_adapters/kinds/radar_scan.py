# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the returns of a radar_msgs/RadarScan become columns."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.table import Columns

NAMES = ('range', 'azimuth', 'elevation', 'doppler_velocity', 'amplitude')
MAY_BE_MISSING = ('elevation', 'doppler_velocity')  # the message has no other way to say so than 0


def radar_scan(msg: Any) -> Columns:
    """
    Return range [m], azimuth and elevation [rad], range rate [m/s], amplitude [dB], each (M,).

    A 2-D radar reports the elevation 0 for all returns, says the message: NaN here. So it is with
    the range rate of a radar without Doppler, that no contact would move otherwise.
    """
    rows = [[getattr(one, name) for name in NAMES] for one in msg.returns]
    values = np.array(rows, np.float64).reshape(-1, len(NAMES))
    for place in map(NAMES.index, MAY_BE_MISSING):
        if not values[:, place].any():
            values[:, place] = np.nan
    return dict(zip(NAMES, values.T, strict=True))
