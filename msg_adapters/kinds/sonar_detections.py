# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the detections of a marine_acoustic_msgs/SonarDetections become columns."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.table import Columns


def sonar_detections(msg: Any) -> Columns:
    """
    Return range [m], azimuth [rad] and time after the stamp [s] of the good detections, (M,) each.

    The message counts receive angles positive to starboard, and its stamp is when the ping left.

    Raises
    ------
    BadMessage
        For arrays of different lengths, or a sound speed that is none.

    """
    travel = np.asarray(msg.two_way_travel_times, np.float64)
    angle = np.asarray(msg.rx_angles, np.float64)
    delay = np.asarray(msg.tx_delays, np.float64)
    delay = delay if len(delay) else np.zeros(len(travel))
    good = np.array([flag.flag == 0 for flag in msg.flags], bool)
    good = good if len(good) else np.ones(len(travel), bool)
    lengths = {
        'two_way_travel_times': len(travel), 'rx_angles': len(angle),
        'tx_delays': len(delay), 'flags': len(good),
    }  # fmt: skip
    if len(set(lengths.values())) > 1:
        told = ', '.join(f'{name} {length}' for name, length in lengths.items())
        raise BadMessage('sizes do not fit', f'arrays differ in length: {told}')
    speed = float(msg.ping_info.sound_speed)
    if len(travel) and not 0.0 < speed < np.inf:
        raise BadMessage('bad sound speed', f'ping_info.sound_speed is {speed:g} m/s')
    one_way = 0.5 * travel
    columns = {'range': speed * one_way, 'azimuth': -angle, 'time': delay + one_way}
    return {name: values[good] for name, values in columns.items()}
