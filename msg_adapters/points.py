# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a position that a user points at is read."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import Floats


def to_position(msg: Any, sensor: tuple[float, float, float], reach: float) -> Floats:
    """
    Return the position (3,) [m] of a PointStamped, in the frame of its header.

    Raises
    ------
    BadMessage
        For a coordinate that is no number or beyond `reach` [m] of the sensor's, in that frame.

    """
    position = np.array([msg.point.x, msg.point.y, msg.point.z])
    if not (np.abs(position - sensor) <= reach).all():
        raise BadMessage(
            'bad point', f'point is {position}, farther than {reach:g} m from the sensor'
        )
    return position
