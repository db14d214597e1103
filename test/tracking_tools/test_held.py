# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a contact was held that leaves the radar's sight and comes back."""

from pathlib import Path

import numpy as np

from tracking_tools.demo_report import report
from tracking_tools.held import find_holds
from tracking_tools.scene import Scene

TURN = 4.0


def test_truth_of_other_moments_is_not_judged() -> None:
    """As of a recording with a truth ten times a second: no contact counts as never held."""
    stamp = TURN * np.arange(20)
    columns = {'stamp': stamp, 'time': stamp, **dict.fromkeys('xyz', 20.0 * stamp)}
    columns |= {axis: np.full(20, 20.0) for axis in ('vx', 'vy', 'vz')}
    columns |= {'covariance': np.tile(np.eye(6).ravel(), (20, 1)), 'id': np.ones(20, int)}
    scene = Scene({}, columns, {**columns, 'stamp': stamp + 0.1, 'time': stamp + 0.1})
    assert find_holds(scene) == []
    said = report(scene, Path('tracks'), '/radar_tracker/tracks', Path('demo.png'))
    assert '1 confirmed tracks, 20 looks; the truth is of other moments' in said


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
