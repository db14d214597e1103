# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of tracks in a pause: that an antenna takes its time to turn is none."""

from __future__ import annotations

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

PERIOD = 4.0  # of the antenna [s]


def turn(number: int) -> Plots:
    """Return the plots of a turn: thirty contacts that stay where they are."""
    rng = np.random.default_rng(1)
    azimuth, distance = np.sort(rng.uniform(0.0, 2.0 * np.pi, 30)), rng.uniform(5e3, 50e3, 30)
    begin, noise = PERIOD * number, np.random.default_rng(number).standard_normal((2, 30))
    return Plots.polar(
        begin + azimuth / (2.0 * np.pi) * PERIOD,
        distance + 50.0 * noise[0],
        azimuth + 1e-3 * noise[1],
        stamp=begin,
    )


@pytest.mark.parametrize('longest', [0.0, 1.0, 3.0, 9.0, 30.0])
def test_turns_of_the_antenna_are_no_pause(longest: float) -> None:
    """However short a pause is set: every contact keeps its track while the antenna turns."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'longest_pause': longest}))
    for number in range(15):
        tracks = tracker.track(turn(number))
        assert tracker.state.report.silent == 0
    assert tracks.confirmed.sum() == 30


def test_longer_pauses_end_tracks() -> None:
    """Twelve turns without a message, where three are the shortest pause."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'longest_pause': 3.0}))
    for number in range(15):
        before = tracker.track(turn(number)).id
    after = tracker.track(turn(27)).id
    assert tracker.state.report.silent == len(before)
    assert not np.isin(before, after).any()
