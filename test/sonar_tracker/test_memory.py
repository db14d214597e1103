# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a sonar tracker has learnt goes over to another one."""

from __future__ import annotations

import numpy as np

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.memory import recall, remember
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings


def test_recalled_tracker_expects_marks_as_sure_as_they_were() -> None:
    """Its gates in a cycle without marks are those of before."""
    heard = SonarTracker(SonarTrackerConfig())
    heard.track(Bearings.of(np.zeros(2), np.array([0.1, 2.0]), bearing_sd=np.full(2, 0.03)))
    other = SonarTracker(SonarTrackerConfig())
    recall(other, remember(heard))
    assert other.sonar.usual_sd == 0.03
    assert other.core.setup.sensor == other.sonar


def test_recalled_tracker_knows_how_noisy_marks_are() -> None:
    """What marks showed beside what they tell is not learnt again."""
    rng, heard = np.random.default_rng(1), SonarTracker(SonarTrackerConfig())
    for time in 2.0 * np.arange(60):
        bearing = np.arange(6.0) - 3.0 + 0.01 * rng.standard_normal(6)
        heard.track(Bearings.of(np.full(6, time), bearing, bearing_sd=np.full(6, 0.003)))
    other = SonarTracker(SonarTrackerConfig())
    recall(other, remember(heard))
    assert other.sonar.raised == heard.sonar.raised > 2.0
