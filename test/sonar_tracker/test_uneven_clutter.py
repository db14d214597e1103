# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A noisy sector, as a shipping lane is, makes no tracks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

INTERVAL, SD, DETECTION = 2.0, 0.0087, 0.9  # [s], [rad]
CYCLES, SETTLED = 150, 50
CONTACTS = np.array([-2.5, -1.0, 0.7, 2.0])  # the third in the lane [rad]
LANE = np.array([0.52, 0.87])  # [rad]


@pytest.mark.parametrize('seed', [1, 2, 3, 4])
def test_shipping_lane_makes_no_tracks(seed: int) -> None:
    """
    Three marks a cycle in 20 degrees; thought to be anywhere, they would be contacts.

    Nor do tracks of the first cycles, when nothing is known, take the marks for their own.
    """
    rng = np.random.default_rng(seed)
    values = {'sensor.bearing_sd': SD, 'ranging.enabled': False}
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    held, false = [], []
    for k in range(CYCLES):
        heard = CONTACTS[rng.random(len(CONTACTS)) < DETECTION]
        bearing = np.concatenate([
            heard + SD * rng.standard_normal(len(heard)), rng.uniform(*LANE, rng.poisson(3.0)),
            rng.uniform(-np.pi, np.pi, rng.poisson(0.5)),
        ])  # fmt: skip
        time = INTERVAL * k
        marks = Bearings.of(np.full(len(bearing), time), bearing)
        tracks = tracker.track(replace(marks, stamp=time))
        off = wrap_angle(tracks.planes[0].average[tracks.confirmed, :1] - CONTACTS)
        near = np.abs(off) < 5.0 * SD
        held.append(near.any(axis=0))
        false.append(int((~near.any(axis=1)).sum()))
    assert np.mean(held[SETTLED:], axis=0).min() > 0.95
    assert np.mean(false[SETTLED:]) < 0.5
