# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ranges beside the tracker: misses, false marks, its public verbs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from studies.v0_ranging import Case, scene, SD
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

DEGREE = np.pi / 180.0


def platform_of(time, own, heading) -> Platform:
    """Own ship at (K, 2) with headings (K,)."""
    none = np.zeros_like(time)
    turn = np.stack([none, none, np.sin(0.5 * heading), np.cos(0.5 * heading)], axis=1)
    velocity = np.column_stack([np.gradient(own, time, axis=0), none])
    position = np.column_stack([own, none])
    return Platform(time, position, turn, velocity, np.zeros((len(time), 3, 3)), none)


def tracked(estimator='modified_polar', cycles=750):
    """Return a tracker after V-0 with misses and false marks, and the line to object 1."""
    time, own, objects = scene(Case())
    platform = platform_of(time, own[:, :2], np.arctan2(own[:, 3], own[:, 2]))
    line = objects[0, :, :2] - own[:, :2]
    rng = np.random.default_rng(5)
    values = {
        'sensor.bearing_sd': SD,
        'clutter_density': 0.5,
        'estimator': estimator,
        'initiation.rate_max': 0.1 * DEGREE,
        'initiation.rate_sd': 0.02 * DEGREE,
    }
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    for k in range(cycles):
        true = np.arctan2(line[k, 1], line[k, 0]) + SD * rng.standard_normal()
        false = rng.uniform(-np.pi, np.pi, rng.poisson(3.0))
        marks = np.append(false, true) if rng.random() < 0.9 else false
        marks = wrap_angle(marks - platform.at(time[k : k + 1]).yaw)
        message = Bearings.of(np.full(len(marks), time[k]), marks)
        tracker.track(Bearings(message.time, marks, message.bearing_sd, message.snr, time[k]),
                      platform)  # fmt: skip
    return tracker, line[:cycles], objects[0, cycles - 1]


def test_tracker_tells_the_range() -> None:
    """Through association, with misses and false marks: true within its sd, row by row."""
    tracker, line, contact = tracked()
    found = tracker.ranges()
    assert_array_equal(found.id, tracker.tracks.id)
    row = int(np.flatnonzero(found.observable)[0])
    assert found.observable.sum() == 1
    near = wrap_angle(bearing_states(tracker.tracks).bearing[row] - np.arctan2(*line[-1, ::-1]))
    assert abs(near) < 5.0 * SD
    assert found.range_sd[row] < 40.0
    off = found.state[row] - contact
    assert off @ np.linalg.solve(found.covariance[row], off) < 25.0
    tracker.ranging.config = replace(tracker.config.ranging, relative_sd=1e-3)
    unsure = tracker.ranges()  # as all are that are not so sure
    assert not unsure.observable.any()
    for values in (unsure.range, unsure.range_sd, unsure.speed, unsure.course, unsure.state):
        assert np.isnan(values).all()
    tracker.reset()
    assert len(tracker.ranges()) == 0


def test_cycles_without_a_mark_tell_nothing_of_ranges() -> None:
    """A contact that falls silent for a while has the marks that were heard."""
    tracker, nothing = SonarTracker(SonarTrackerConfig()), np.zeros(0)
    for k in range(10):
        tracker.track(Bearings.of(np.full(1, 2.0 * k), np.full(1, 0.3)))
    heard = tracker.ranging.history.remember()
    for k in (10, 11):
        tracker.track(Bearings(nothing, nothing, nothing, nothing, 2.0 * k))
    assert tracker.tracks.misses.tolist() == [2]
    assert_array_equal(tracker.ranging.history.remember()['count'], heard['count'])


def test_ranging_can_be_off() -> None:
    """Without ranging the filters are bare and nothing is told."""
    values = {'ranging.enabled': False, 'estimator': 'kalman'}  # one that needs no memory
    config = with_values(SonarTrackerConfig(), values)
    tracker = SonarTracker(config)
    tracker.start_track(np.array([0.3]), 0.0)
    assert tracker.tracks.planes[0].memory.shape == (1, 0)
    assert_array_equal(tracker.ranges().observable, [False])


def test_cycles_that_are_followed_again_tell_nothing_new_of_ranges() -> None:
    """For a late cycle the tracker goes back to before the track was; its marks are all kept."""
    tracker = SonarTracker(with_values(SonarTrackerConfig(), {'sensor.bearing_sd': SD}))
    rng = np.random.default_rng(1)
    cycles = [
        Bearings.of(np.full(1, 2.0 * k), rng.normal(0.3, SD, 1), bearing_sd=np.full(1, SD))
        for k in range(12)
    ]
    before = tracker.save()
    for cycle in cycles:
        tracker.track(cycle)
    heard = tracker.ranging.history.remember()
    assert 8 <= heard['count'][0] < len(cycles)  # from its confirmation on
    tracker.restore(before)
    late = Bearings.of(np.full(1, 1.0), np.full(1, 0.3), bearing_sd=np.full(1, SD))
    for cycle in (cycles[0], late, *cycles[1:]):
        tracker.track(cycle)
    again = tracker.ranging.history.remember()
    assert_array_equal(again['count'], heard['count'])
    assert_array_equal(again['points'], heard['points'])


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'range_min': 5e3, 'range_max': 1e3}, 'must be below range_max'),
        ({'points': 20, 'least_points': 12}, 'at most points / 2'),
    ],
)
def test_config_refuses_what_does_not_fit(values, words: str) -> None:
    """Parameters that contradict each other are refused, with what would be right."""
    with pytest.raises(ValueError, match=words):
        RangingConfig(**values)


@pytest.mark.parametrize('seed', [0, 9])
def test_range_is_kept_while_the_bow_swings_across_the_contact(seed) -> None:
    """Marks near a linear array's axis are blurred, and the fit creeps: it is not called bent."""
    time = np.arange(1400.0)
    heading = np.clip(0.01 * (time - 500.0), -1.2, 1.2)
    steps = 5.0 * np.stack([np.cos(heading), np.sin(heading)], axis=1)[:-1]
    place = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    ship = platform_of(time, place, heading)
    values = {'sensor.bearing_sd': 0.004, 'sensor.array': 'linear', 'ranging.heading_noise': 0.0}
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    rng, told = np.random.default_rng(seed), []
    for k in range(1, 1400, 2):
        line = np.array([3000.0, 4000.0]) - place[k]
        bearing = np.arctan2(line[1], line[0]) - heading[k]
        bearing += rng.normal(0.0, 0.004 / max(abs(np.sin(bearing)), 0.05))
        heard = np.array([bearing])[: int(rng.random() < 0.9)]
        marks = Bearings.of(np.full(len(heard), time[k]), wrap_angle(heard))
        tracker.track(replace(marks, stamp=time[k]), ship)
        told.append(bool(tracker.ranges().observable.any()))
    assert np.mean(told[-200:]) == 1.0
