# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are the angles of a message in radians? Those in degrees are refused, or turned into them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import Floats

ANGLES = ('azimuth', 'elevation', 'bearing', 'azimuth_sd', 'elevation_sd', 'bearing_sd')
AROUND = ('azimuth', 'bearing')  # these go all around, and tell which unit it is
WIDEST, WIDEST_IN_DEGREES = 2.02 * np.pi, 361.0  # a full turn, with some rounding
MANY = 0.5  # of the rows that are numbers; fewer are faults of their own


def in_radians(values: Mapping[str, Floats], unit: str) -> dict[str, Floats]:
    """
    Return the columns (M,) with angles in radians.

    A row of degrees may look like radians, as 5 degrees do, so it is the message that is judged.

    Parameters
    ----------
    values : mapping
        Columns by our names.
    unit : str
        'rad' or 'deg', as the user says.

    Raises
    ------
    BadMessage
        For radians that look like degrees.

    """
    if unit == 'deg':
        return {n: np.radians(v) if n in ANGLES else v for n, v in values.items()}
    for name in AROUND:
        angle = np.abs(values.get(name, np.zeros(0)))
        wide = np.count_nonzero((angle > WIDEST) & (angle <= WIDEST_IN_DEGREES))
        if wide and wide >= MANY * np.count_nonzero(np.isfinite(angle)):
            raise BadMessage(
                'angles in degrees?',
                f'{name} is beyond 2 pi in {wide} of {len(angle)} rows: if angles are in degrees, '
                'set sensor.angle_unit to deg',
            )
    return dict(values)
