# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How wide are the gates of a sonar, whose marks and own ship may tell how unsure they are?"""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.platform import Platform

DEGREE = np.pi / 180.0
BEARINGS = DEGREE * np.array([-100.0, -40.0, 10.0, 60.0, 130.0])
CONFIG = with_values(SonarTrackerConfig(), {'sensor.bearing_sd': 0.1 * DEGREE})


def at_anchor(heading_sd: float) -> Platform:
    """Own ship that lies still and knows its heading this well [rad]."""
    turn, nothing = np.array([[0.0, 0.0, 0.0, 1.0]]), np.zeros((1, 3))
    yaw_variance = np.array([heading_sd**2])
    return Platform(
        np.zeros(1), nothing, turn, nothing, np.zeros((1, 3, 3)), yaw_variance,
        max_extrapolation=1e9,
    )  # fmt: skip


def followed(sd, told, heading_sd=0.0, cycles=150):
    """Return the tracker after cycles with marks of these sd (5,), and the misses on the way."""
    rng, tracker, misses = np.random.default_rng(1), SonarTracker(CONFIG), []
    for cycle in range(cycles):
        bearing = BEARINGS + rng.normal(0.0, sd) + rng.normal(0.0, heading_sd)
        time = np.full(len(BEARINGS), 2.0 * cycle)
        marks = Bearings.of(time, bearing, bearing_sd=told)
        tracks = tracker.track(marks, at_anchor(heading_sd))
        if cycle >= 30:
            misses.append(tracks.misses[tracks.confirmed] > 0)
    return tracker, np.concatenate(misses)


@pytest.mark.parametrize('told', [2.0, np.nan])
@pytest.mark.parametrize('heading_sd', [0.0, 1.5])
def test_published_gate_is_as_wide_as_marks_and_heading_are_unsure(told, heading_sd) -> None:
    """Three sd of track and usual mark together: what the mark tells, else the parameter."""
    sd = np.full(len(BEARINGS), told * DEGREE)
    mark_sd = np.where(np.isfinite(sd), sd, CONFIG.sensor.bearing_sd)
    tracker, _ = followed(mark_sd, sd, heading_sd * DEGREE)
    tracks = tracker.tracks
    assert len(tracks) == len(BEARINGS)
    noise = np.hypot(mark_sd, heading_sd * DEGREE)
    gate = tracks.gate_size[:, 0]
    assert (gate > 3.0 * noise).all()
    track_sd = np.sqrt(tracks.planes[0].moments()[1][:, 0, 0])
    # The track before the look was a little less sure than after it.
    assert_allclose(gate, 3.0 * np.hypot(noise, track_sd), rtol=0.1)


def test_marks_less_sure_than_the_others_keep_their_track() -> None:
    """Of five contacts one tells fifteen times the noise of the others: each keeps one id."""
    sd = DEGREE * np.array([0.1, 0.1, 0.1, 0.1, 1.5])
    tracker, misses = followed(sd, sd)
    assert tracker.tracks.id.max() == len(BEARINGS)  # 21 with boxes for the usual mark's noise
    assert misses.mean() < 0.01  # 8 % with these
    assert (tracker.tracks.gate_size[:4] < 1.0 * DEGREE).all()  # of its marks 4.5
