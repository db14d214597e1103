# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Wherever messages are cut, in whatever parts: the tracks are those of the same plots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.linalg import TURN
from tracking_core.rows import take
from tracking_tools.scenarios import NORTH

PERIOD = 4.0


@pytest.mark.parametrize('sense', [1.0, -1.0], ids=['anticlockwise', 'clockwise'])
def test_plot_before_the_cut_is_that_of_a_track_behind_it(sense: float) -> None:
    """A contact leaps back over the cut by less than its gate: the early plot waits for it."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'scan.period': PERIOD}))
    leaps, turns = 7, 9
    across = np.where(np.arange(turns + 1) < leaps, 150.0, -350.0)  # [m] behind the cut
    contact = NORTH + sense * np.arctan(across / 25_000.0)
    azimuth = np.concatenate([contact, np.tile([0.5, -0.5, -2.5], turns)])
    turn = np.concatenate([np.arange(turns + 1), np.repeat(np.arange(turns), 3)])
    into = np.remainder(sense * (azimuth - NORTH), TURN) / TURN
    time = PERIOD * (turn + into - (turn >= leaps) * (into > 0.99))
    everything = Plots.polar(time, np.full(len(time), 25_000.0), azimuth)
    for k in range(turns):
        within = np.flatnonzero((time >= PERIOD * k) & (time < PERIOD * (k + 1)))
        tracker.track(replace(take(everything, within), stamp=PERIOD * k))
    assert len(tracker.tracks) == tracker.state.next_id - 1 == 4
    assert (tracker.tracks.misses == 0).all()
