# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Tracks that were followed once more keep the ids that they had."""

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.config import with_values
from tracking_core.identity import keep_ids
from tracking_core.rows import take
from tracking_core.space import ANGLES


def state_of(x_of_ids):
    """Return the state of a tracker with tracks of these ids at these places [m]."""
    tracker = RadarTracker(RadarTrackerConfig())
    for number, place in x_of_ids.items():
        tracker.state = replace(tracker.state, next_id=number)
        tracker.start_track(np.array([place, 0.0]), 0.0)
    return tracker.state


def test_tracks_at_the_same_place_keep_their_ids():
    """Two in the other order, one that is new and gets an id nobody had."""
    before, after = state_of({1: 0.0, 2: 5e3, 3: 9e3}), state_of({1: 0.0, 4: 9e3, 5: 7e4, 6: 5e3})
    kept = keep_ids(before, after, first=4)
    where = kept.tracks.planes[0].moments()[0][:, 0]
    assert_array_equal(kept.tracks.id, [1, 2, 3, 4])
    assert_allclose(where, [0.0, 5e3, 9e3, 7e4])
    assert kept.next_id == 5


def test_ids_are_never_given_twice():
    """What was told of a track that has no second is not told of another."""
    before, after = state_of({1: 0.0, 2: 5e3}), state_of({1: 0.0, 9: 6e4})
    kept = keep_ids(before, after, first=9)
    assert_array_equal(kept.tracks.id, [1, 9])
    assert kept.next_id == 10


def test_tracks_of_an_earlier_scan_keep_their_ids():
    """One began before the last scan and has no second; nobody else gets its id."""
    before, after = state_of({1: 0.0}), state_of({1: 0.0, 5: 6e4, 7: 8e4})
    kept = keep_ids(before, after, first=6)
    assert_array_equal(kept.tracks.id, [1, 5, 6])
    assert kept.next_id == 7


def test_nothing_to_compare_is_no_fault():
    """No tracks before, none after, or the same in both."""
    before, after = state_of({}), state_of({1: 0.0, 2: 5e3})
    assert_array_equal(keep_ids(before, after, first=1).tracks.id, [1, 2])
    nobody = replace(after, tracks=take(after.tracks, np.zeros(0, np.int64)))
    assert keep_ids(after, nobody, first=3).next_id == after.next_id
    assert_array_equal(keep_ids(after, after, first=3).tracks.id, [1, 2])


def test_nobody_is_the_same_in_other_dimensions():
    """The radar was found to tell heights: all get new ids, either way round."""
    solid = RadarTracker(with_values(RadarTrackerConfig(), {'sensor.dimensions': 3}))
    solid.start_track(np.zeros(3), 0.0)
    joint = RadarTracker(
        with_values(
            RadarTrackerConfig(),
            {'sensor.dimensions': 3, 'estimator': 'markov_jump_joint'},
        )
    )
    joint.start_track(np.zeros(3), 0.0)
    flat = state_of({2: 0.0, 3: 5e3})
    for after in (solid.state, joint.state):
        assert_array_equal(keep_ids(flat, after, first=1).tracks.id, [1])
        assert_array_equal(keep_ids(after, flat, first=2).tracks.id, [2, 3])


def test_bearings_a_turn_apart_are_the_same():
    """A contact beside +-pi, told on either side of it."""
    tracker = SonarTracker(SonarTrackerConfig())
    tracker.start_track(np.array([np.pi - 0.001]), 0.0)
    before = tracker.state
    tracker.reset()  # but for the next id
    tracker.start_track(np.array([-np.pi + 0.001]), 0.0)
    kept = keep_ids(before, tracker.state, first=2, space=ANGLES)
    assert_array_equal(kept.tracks.id, before.tracks.id)
