# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of tracks that nobody looked at for minutes."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings, Floats
from tracking_core.config import with_values

BEARINGS = np.array([-1.0, 0.5, 2.0])  # of contacts that stay where they are [rad]
PERIOD, PAUSE = 10.0, 300.0  # [s]


def heard(time: Floats, rng: np.random.Generator) -> list[Bearings]:
    """Return a cycle with a mark of every contact for each time."""
    noise = 0.01 * rng.standard_normal((len(time), len(BEARINGS)))
    return [
        Bearings.of(np.full(len(BEARINGS), now), BEARINGS + error, stamp=now)
        for now, error in zip(time.tolist(), noise, strict=True)
    ]


@pytest.mark.parametrize(('longest', 'go_on'), [(0.0, True), (100.0, False), (400.0, True)])
def test_tracks_end_in_a_pause_that_is_too_long(longest: float, go_on: bool) -> None:
    """Old ids live on or are all reported as deleted, and new ones follow the contacts."""
    rng, times = np.random.default_rng(1), PERIOD * np.arange(15)
    tracker = SonarTracker(
        with_values(SonarTrackerConfig(), {'longest_pause': longest, 'clutter_density': 0.1})
    )
    for cycle in heard(times, rng):
        before = tracker.track(cycle)
    assert before.confirmed.sum() == len(BEARINGS)

    first, *rest = heard(times[-1] + PAUSE + times, rng)
    tracker.track(first)
    ended = tracker.state.report.deleted
    assert_array_equal(ended, before.id[:0] if go_on else before.id)
    for cycle in rest:
        after = tracker.track(cycle)
    assert after.confirmed.sum() == len(BEARINGS)
    assert np.isin(after.id[after.confirmed], before.id).all() == go_on
    assert np.isin(after.id, before.id).any() == go_on


def test_marks_before_a_pause_start_no_track_after_it() -> None:
    """Two marks at one bearing make a contact only if no pause was between them."""
    for longest, starts in ((0.0, True), (100.0, False)):
        tracker = SonarTracker(
            with_values(SonarTrackerConfig(), {'longest_pause': longest, 'clutter_density': 0.1})
        )
        for cycle in heard(np.array([0.0, PAUSE]), np.random.default_rng(1)):
            tracks = tracker.track(cycle)
        assert (len(tracks) > 0) == starts
