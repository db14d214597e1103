# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a user may do to a sonar tracker under way: order tracks, change parameters, go back."""

from __future__ import annotations

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.platform import Platform

OTHER = with_values(SonarTrackerConfig(), {'sensor.detection_probability': 0.5})


def in_use(tracker: SonarTracker) -> tuple[float, float]:
    """Return P_D as the tracker tells it, and as it tracks with it."""
    told, used = tracker.config.sensor, tracker.core.setup.sensor
    return told.detection_probability, used.detection_probability


def test_parameters_hold_after_a_reset_and_when_late_marks_come() -> None:
    """Forgetting tracks, and going back to a moment before the change, bring no old ones back."""
    tracker = SonarTracker(SonarTrackerConfig())
    before = tracker.save()
    tracker.reconfigure(OTHER)
    assert in_use(tracker) == (0.5, 0.5)
    tracker.restore(before)
    assert in_use(tracker) == (0.5, 0.5)
    tracker.reset()
    assert in_use(tracker) == (0.5, 0.5)


def test_going_back_brings_the_moment_back() -> None:
    """Tracks, next id, and where the sonar was."""
    tracker = SonarTracker(SonarTrackerConfig())
    tracker.start_track(np.array([1.0]), 0.0)
    before, tracks = tracker.save(), tracker.tracks
    tracker.track(Bearings.of(np.array([2.0]), np.array([1.0])), sailing(2.0))
    tracker.start_track(np.array([2.0]), 2.0)
    assert tracker.sensor_position != (0.0, 0.0, 0.0)
    tracker.restore(before)
    assert tracker.tracks is tracks
    assert tracker.state.next_id == 2
    assert tracker.sensor_position == (0.0, 0.0, 0.0)


def sailing(time: float) -> Platform:
    """Own ship at (300, 400) m that sails north at 10 m/s, known at one time."""
    position, velocity = np.array([[300.0, 400.0, 0.0]]), np.array([[0.0, 10.0, 0.0]])
    turn = np.array([[0.0, 0.0, 0.0, 1.0]])
    return Platform(
        np.array([time]), position, turn, velocity, np.zeros((1, 3, 3)), np.zeros(1),
        max_extrapolation=1e3,
    )  # fmt: skip


@pytest.mark.parametrize('point', [(1300.0, 420.0), (300.0, -1000.0), (-700.0, 1420.0, 5.0)])
def test_ordered_track_is_on_the_bearing_of_its_point_from_own_ship(point) -> None:
    """From where own ship is at the time of the order, two seconds after the cycle."""
    tracker = SonarTracker(SonarTrackerConfig())
    tracker.track(Bearings.of(np.array([10.0]), np.array([0.5])), sailing(10.0))
    tracker.start_track(np.array(point), 12.0)
    line = np.array(point[:2]) - [300.0, 420.0]
    bearing = bearing_states(tracker.tracks).bearing[-1]
    assert bearing == pytest.approx(np.arctan2(line[1], line[0]))
