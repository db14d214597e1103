# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far did the antenna turn from sector to sector, if all these plots were in their sectors?"""

from __future__ import annotations

import numpy as np

from radar_tracker.rotation import PERIODS
from tracking_core.batches import Floats
from tracking_core.linalg import TURN

SECTORS = np.arange(3, 97)  # of a turn; of two nobody can tell which way the antenna turns
_TURNS, _PART = 3.0, 0.1  # of the antenna that must be seen; and for so many sectors at least
_FIT = 0.95  # of the mean resultant length that evenly filled sectors have
_SURE = 0.1  # so much better than the same turn the other way round


def best_turn(azimuth: Floats, count: Floats, step: float, period: float) -> float:
    """
    Return the turn from sector to sector that fits best [rad], 0 if none does.

    Parameters
    ----------
    azimuth : (M,) array
        Of plots [rad].
    count : (M,) array
        In which sector each was, counted from any of them.
    step : float
        From sector to sector [s].
    period : float
        Of a turn, if it is known, else 0 [s].

    """
    sectors = np.array([round(period / step)]) if period else SECTORS
    sectors = sectors[(sectors * step > PERIODS[0]) & (sectors * step < PERIODS[1])]
    if not len(sectors):
        return 0.0
    turns = np.stack([TURN / sectors, -TURN / sectors])
    beam = azimuth - turns[..., None] * count
    fit = np.abs(np.exp(1j * beam).mean(axis=-1)) / np.sinc(1.0 / sectors)
    way, best = np.unravel_index(np.argmax(fit), fit.shape)
    least = _TURNS if period else max(_TURNS, _PART * sectors[best])
    if fit[way, best] < _FIT or np.ptp(count) < least * sectors[best]:
        return 0.0
    if fit[way, best] > fit[1 - way, best] + _SURE:
        return float(turns[way, best])
    # Both ways fit few contacts; most antennas turn clockwise, and a sector is short.
    return float(turns[1, best]) if period else 0.0
