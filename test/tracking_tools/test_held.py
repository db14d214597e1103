# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a contact was held that leaves the radar's sight and comes back."""

import numpy as np

from tracking_tools.held import find_holds
from tracking_tools.scene import Scene

TURN = 4.0


def test_time_out_of_sight_is_no_time_in_sight() -> None:
    """Ten turns there, fifty away, ten there again: 36 s and 36 s, and a new id is no switch."""
    stamp = TURN * np.concatenate([np.arange(10), np.arange(60, 70)])
    columns = {'stamp': stamp, 'time': stamp, **dict.fromkeys('xyz', 20.0 * stamp)}
    columns |= {axis: np.full(20, 20.0) for axis in ('vx', 'vy', 'vz')}
    columns['covariance'] = np.tile(np.eye(6).ravel(), (20, 1))
    ids = np.repeat([1, 2], 10)
    (hold,) = find_holds(Scene({}, {**columns, 'id': ids}, {**columns, 'id': np.ones(20, int)}))
    assert hold.duration == 72.0
    assert hold.share == 1.0
    assert (hold.switches, hold.returns) == (0, 1)
