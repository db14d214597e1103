# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which marks nearer to a contact than the resolution limit may be a contact of their own?"""

from __future__ import annotations

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values

LIMIT = np.radians(5.0)
VALUES = {'sensor.bearing_sd': 0.005, 'sensor.bearing_resolution': LIMIT}


@pytest.mark.parametrize(('contact_is_heard', 'tracks'), [(True, 1), (False, 2)])
def test_contact_that_is_not_heard_hides_nothing(contact_is_heard: bool, tracks: int) -> None:
    """A mark of its own excludes another so near; without one the other may be somebody else."""
    tracker = SonarTracker(with_values(SonarTrackerConfig(), VALUES))
    for cycle in range(23):
        stray = [0.5 + 0.6 * LIMIT] if cycle >= 20 else []
        bearing = np.array(stray + ([0.5] if contact_is_heard or cycle < 20 else []))
        tracker.track(Bearings.of(np.full(len(bearing), 2.0 * cycle), bearing))
    assert len(tracker.tracks) == tracks
