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


def look(time: float, rng: np.random.Generator, dimensions: int) -> Plots:
    """Return plots of three contacts at rest, with range rates."""
    place = np.array([[2e4, 1e4, 3e3], [-3e4, 2e4, 5e3], [5e3, -4e4, 1e3]])[:, :dimensions]
    place += rng.normal(0.0, 30.0, place.shape)
    ground = np.hypot(place[:, 0], place[:, 1])
    columns = {'range_rate': rng.normal(0.0, 2.0, 3)}
    if dimensions == 3:
        columns['elevation'] = np.arctan2(place[:, 2], ground)
    return Plots.polar(
        np.full(3, time), np.linalg.norm(place, axis=1), np.arctan2(place[:, 1], place[:, 0]),
        stamp=time, **columns,
    )  # fmt: skip


@pytest.mark.parametrize('estimator', ['markov_jump', 'markov_jump_joint', 'imm_alpha_beta'])
@pytest.mark.parametrize('dimensions', [2, 3])
@pytest.mark.parametrize('pause', [1e7, 1e9])
def test_pause_of_months_is_survived(estimator: str, dimensions: int, pause: float) -> None:
    """A contact may be anywhere, farther than numbers can tell: no error, and new tracks."""
    values = {'estimator': estimator, 'scan.assembly': 'snapshot', 'sensor.dimensions': dimensions}
    tracker, rng = (
        RadarTracker(with_values(RadarTrackerConfig(), values)),
        np.random.default_rng(0),
    )
    for number in range(24):
        time = PERIOD * number + pause * (number > 5)
        tracks = tracker.track(look(time, rng, dimensions))
    assert tracks.confirmed.sum() == 3
    assert (tracks.misses[tracks.confirmed] == 0).all()
