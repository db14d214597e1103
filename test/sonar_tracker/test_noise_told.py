# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Marks that are noisier than they tell are tracked as if they told it."""

from __future__ import annotations

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values

SD, TELLS = np.radians(0.5), np.radians(0.5) / 3.0  # [rad]
CYCLES, LEARNT = 300, 60


def outcome(in_marks: bool) -> tuple[int, float, float]:
    """Return ids that came after it had learnt, tracks at a time, and NEES, of six contacts."""
    rng, tracker = np.random.default_rng(1), SonarTracker(SonarTrackerConfig())
    if not in_marks:
        told = {'sensor.bearing_sd': TELLS}
        tracker = SonarTracker(with_values(SonarTrackerConfig(), told))
    sd = np.full(6, TELLS if in_marks else np.nan)
    new, known, count, squares = set(), set(), [], []
    for cycle in range(CYCLES):
        time = np.full(6, 2.0 * cycle)
        true = np.arange(6.0) - 3.0 + 1e-4 * time
        heard = rng.random(6) < 0.9
        marks = Bearings.of(
            time[heard], (true + SD * rng.standard_normal(6))[heard], bearing_sd=sd[heard]
        )
        tracks = tracker.track(marks)
        ids = set(tracks.id[tracks.confirmed].tolist())
        if cycle >= LEARNT:
            mean, P = tracks.planes[0].moments()
            off = mean[:, :1] - true
            squares += (np.abs(off).min(axis=1) ** 2 / P[:, 0, 0])[tracks.confirmed].tolist()
            new |= ids - known
            count.append(len(ids))
        known |= ids
    return len(new), float(np.mean(count)), float(np.mean(squares))


@pytest.mark.parametrize('in_marks', [True, False])
def test_marks_three_times_as_noisy_as_told_have_one_track_a_contact(in_marks) -> None:
    """By what is told alone: 11 new ids, 8.9 tracks at a time, NEES 22."""
    new, tracks, nees = outcome(in_marks)
    assert new <= 2
    assert tracks < 6.5
    assert nees < 2.5
