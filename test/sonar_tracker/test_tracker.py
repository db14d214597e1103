# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Bearings to tracks on small scenes: all directions, moving own ship, the public verbs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.estimators import BEARING_ESTIMATORS
from tracking_core.linalg import wrap_angle
from tracking_core.merging import duplicates
from tracking_core.platform import Platform, StalePlatform
from tracking_core.rows import concatenate
from tracking_core.space import ANGLES

DEGREE = np.pi / 180.0
PERIOD, CYCLES = 2.0, 120
VALUES = {
    'sensor.bearing_sd': 0.3 * DEGREE,
    'clutter_density': 0.4,
    'initiation.rate_max': 0.5 * DEGREE,
    'initiation.rate_sd': 0.1 * DEGREE,
}
every_estimator = pytest.mark.parametrize('estimator', BEARING_ESTIMATORS)


def cycles(truth, seed=1, false_marks=2.0, detection=0.95) -> list[Bearings]:
    """Make the marks of contacts with true bearings (K, C) in sensor axes, wrapped."""
    rng, made = np.random.default_rng(seed), []
    for k, row in enumerate(truth):
        seen = row[rng.random(len(row)) < detection]
        true = seen + 0.3 * DEGREE * rng.standard_normal(len(seen))
        false = rng.uniform(-np.pi, np.pi, rng.poisson(false_marks))
        marks = wrap_angle(np.concatenate([true, false]))
        made.append(Bearings(np.full(len(marks), PERIOD * k), marks, np.full(len(marks), np.nan),
                             np.full(len(marks), np.nan), PERIOD * k))  # fmt: skip
    return made


def drifting(*start_and_rate) -> np.ndarray:
    """Return true bearings (K, C) of contacts from their start and rate [deg, deg/s]."""
    time = PERIOD * np.arange(CYCLES)[:, None]
    start, rate = np.array(start_and_rate).T
    return DEGREE * (start + rate * time)


def followed(messages, platform=None, **values):
    """Return the tracker after the messages, and id and bearing of confirmed tracks by cycle."""
    named = {name.replace('__', '.'): value for name, value in values.items()}
    tracker, seen = SonarTracker(with_values(SonarTrackerConfig(), {**VALUES, **named})), []
    for message in messages:
        tracks = tracker.track(message, platform)
        seen.append((tracks.id[tracks.confirmed],
                     bearing_states(tracks).bearing[tracks.confirmed]))  # fmt: skip
    return tracker, seen


def ids_near(seen, truth, tolerance=1.0 * DEGREE) -> list[set[int]]:
    """Return the ids that were near each contact in the second half of the scene."""
    near: list[set[int]] = [set() for _ in truth[0]]
    for (ids, bearing), row in list(zip(seen, truth, strict=True))[CYCLES // 2 :]:
        for found, true in zip(near, row, strict=True):
            found |= set(ids[np.abs(wrap_angle(bearing - true)) < tolerance].tolist())
    return near


@every_estimator
def test_track_follows_contacts_across_the_wrap(estimator: str) -> None:
    """Contacts that pass +-pi keep one id like any other, and nothing else is confirmed."""
    truth = drifting((165.0, 0.05), (178.5, 0.02), (-172.0, 0.01), (-160.0, -0.02))
    tracker, seen = followed(cycles(truth), estimator=estimator)
    near = ids_near(seen, truth)
    assert [len(ids) for ids in near] == [1, 1, 1, 1]
    assert len(tracker.tracks.id[tracker.tracks.confirmed]) == 4
    last = bearing_states(tracker.tracks).bearing
    assert (np.abs(last) <= np.pi).all()


def test_track_is_the_same_wherever_the_wrap_lies() -> None:
    """Turning all bearings turns the answer."""
    truth = drifting((160.0, 0.2), (20.0, 0.1), (-90.0, -0.1))
    here = followed(cycles(truth))[0].tracks
    turned = [
        Bearings(m.time, wrap_angle(m.bearing + 2.0), m.bearing_sd, m.snr, m.stamp)
        for m in cycles(truth)
    ]
    there = followed(turned)[0].tracks
    assert_array_equal(there.id, here.id)
    apart = wrap_angle(bearing_states(there).bearing - bearing_states(here).bearing)
    assert_allclose(apart, 2.0, atol=1e-9)


def test_track_starts_across_the_wrap() -> None:
    """Two marks on either side of +-pi start a track of the right rate."""
    truth = np.array([[179.9], [180.1]]) * DEGREE
    tracker, _ = followed(cycles(truth, false_marks=0.0, detection=1.0))
    assert len(tracker.tracks) == 1
    assert bearing_states(tracker.tracks).bearing_rate[0] == pytest.approx(0.1 * DEGREE, abs=3e-3)


def test_doubles_across_the_wrap_are_ended() -> None:
    """Two tracks on one contact, one whole turn apart: the younger goes."""
    tracker, _ = followed(cycles(drifting((179.5, 0.005)), false_marks=0.0, detection=1.0)[:60])
    one = tracker.tracks
    mean = one.planes[0].mean.copy()
    mean[..., 0] -= 2.0 * np.pi
    double = replace(one, id=one.id + 1, planes=(replace(one.planes[0], mean=mean),))
    both = concatenate(one, double)
    assert_array_equal(duplicates(both, 1.0, space=ANGLES), [False, True])
    assert not duplicates(both, 1.0).any()


def test_contact_hides_marks_nearer_than_the_limit() -> None:
    """A stray mark beside a contact that has its own mark starts nothing, but for the limit."""
    steady = cycles(drifting((10.0, 0.0)), false_marks=0.0, detection=1.0)
    stray = [
        Bearings(np.append(m.time, m.stamp), np.append(m.bearing, 13.0 * DEGREE),
                 np.append(m.bearing_sd, np.nan), np.append(m.snr, np.nan), m.stamp)
        for m in steady[20:30]
    ]  # fmt: skip
    for limit, tracks in ((5.0, 1), (0.0, 2)):
        tracker, _ = followed(steady[:20] + stray, sensor__bearing_resolution=limit * DEGREE)
        assert len(tracker.tracks) == tracks


def circling(duration: float) -> Platform:
    """Own ship that turns all the time at 5 m/s."""
    time = np.arange(-5.0, duration + 5.0, 1.0)
    yaw = 0.02 * time
    radius = 5.0 / 0.02
    position = np.stack([radius * np.sin(yaw), radius * (1.0 - np.cos(yaw)), 0.0 * time], axis=1)
    velocity = 5.0 * np.stack([np.cos(yaw), np.sin(yaw), 0.0 * time], axis=1)
    turn = np.stack([0.0 * time, 0.0 * time, np.sin(0.5 * yaw), np.cos(0.5 * yaw)], axis=1)
    return Platform(time, position, turn, velocity, np.zeros((len(time), 3, 3)), 0.0 * time)


@every_estimator
def test_track_takes_the_turning_own_ship_out(estimator: str) -> None:
    """A contact at rest keeps its id although the own ship turns through more than a circle."""
    platform = circling(PERIOD * CYCLES)
    time = PERIOD * np.arange(CYCLES)
    pose = platform.at(time)
    line = np.array([3000.0, 4000.0]) - pose.position[:, :2]
    true = np.arctan2(line[:, 1], line[:, 0])[:, None]
    _, seen = followed(cycles(true - pose.yaw[:, None]), platform, estimator=estimator,
                       motion__rate_noise=[5e-5])  # fmt: skip
    assert len(ids_near(seen, true)[0]) == 1


def test_track_refuses_stale_own_ship() -> None:
    """Marks long after the last sample of own ship are not guessed at."""
    tracker = SonarTracker(SonarTrackerConfig())
    with pytest.raises(StalePlatform, match='s away from the samples'):
        tracker.track(Bearings.of(np.array([500.0]), np.zeros(1)), circling(100.0))


def test_track_takes_empty_cycles() -> None:
    """A contact that falls silent is dropped; ids go on."""
    truth = drifting((10.0, 0.0))
    messages = cycles(truth, false_marks=0.0)
    silent = [Bearings(np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0), PERIOD * k)
              for k in range(CYCLES, CYCLES + 60)]  # fmt: skip
    tracker, _ = followed(messages + silent)
    assert len(tracker.tracks) == 0
    assert tracker.state.next_id > 1


def test_marks_of_their_own_sd_count_by_it() -> None:
    """A mark that tells a small sd pulls harder than one that tells a large sd."""
    for sd, low, high in ((0.01, 0.9, 1.01), (2.0, 0.0, 0.35)):
        messages = [
            Bearings.of(np.array([2.0 * k]), np.zeros(1), bearing_sd=np.full(1, 0.3 * DEGREE))
            for k in range(20)
        ]
        last = Bearings.of(np.array([40.0]), np.full(1, 0.4 * DEGREE),
                           bearing_sd=np.full(1, sd * DEGREE))  # fmt: skip
        tracker, _ = followed([*messages, last], gate__probability=0.999)
        moved = bearing_states(tracker.tracks).bearing[0] / (0.4 * DEGREE)
        assert low < moved < high


def test_start_and_drop_and_reset() -> None:
    """The verbs of the node: acquire on a bearing or a point, cancel, forget all."""
    tracker = SonarTracker(SonarTrackerConfig())
    first = tracker.start_track(np.array([1.0]), 0.0)
    second = tracker.start_track(np.array([0.0, 500.0, 0.0]), 0.0)
    assert_allclose(bearing_states(tracker.tracks).bearing, [1.0, 0.5 * np.pi])
    assert tracker.tracks.confirmed.all()
    assert tracker.drop_track(first)
    assert not tracker.drop_track(first)
    assert tracker.tracks.id.tolist() == [second]
    tracker.reset()
    assert len(tracker.tracks) == 0
    assert tracker.start_track(np.array([1.0]), 0.0) == second + 1


def test_reconfigure_keeps_the_tracks() -> None:
    """Live parameters change under way."""
    tracker, _ = followed(cycles(drifting((10.0, 0.0)), false_marks=0.0))
    before = tracker.tracks.id.tolist()
    tracker.reconfigure(with_values(tracker.config, {'sensor.detection_probability': 0.5}))
    assert tracker.tracks.id.tolist() == before
    assert tracker.core.setup.sensor.detection_probability == 0.5


@pytest.mark.parametrize('lifecycle', ['existence', 'm_of_n', 'error_ratio'])
def test_every_lifecycle_confirms_and_drops(lifecycle: str) -> None:
    """A contact is confirmed; five silent cycles end it where cycles are counted."""
    messages = cycles(drifting((10.0, 0.0)), false_marks=0.0, detection=1.0)[:40]
    silent = [Bearings(np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0), 80.0 + PERIOD * k)
              for k in range(5)]  # fmt: skip
    tracker, seen = followed(messages, lifecycle=lifecycle)
    assert len(seen[-1][0]) == 1
    tracker, _ = followed(messages + silent, lifecycle=lifecycle)
    if lifecycle != 'existence':
        assert len(tracker.tracks) == 0


def test_coverage_of_the_array_is_not_a_miss() -> None:
    """A contact that drifts out of the sector is not missed there, and goes after a while."""
    truth = drifting((30.0, 0.5))
    inside = np.abs(truth[:, 0]) < 45.0 * DEGREE
    messages = [m if ok else Bearings(m.time[:0], m.time[:0], m.time[:0], m.time[:0], m.stamp)
                for m, ok in zip(cycles(truth, false_marks=0.0, detection=1.0), inside,
                                 strict=True)]  # fmt: skip
    first_out = int(np.argmin(inside))
    tracker, _ = followed(messages[: first_out + 3], sensor__sector_width=90.0 * DEGREE)
    assert tracker.tracks.confirmed.tolist() == [True]
    tracker, _ = followed(messages[: first_out + 20], sensor__sector_width=90.0 * DEGREE)
    assert len(tracker.tracks) == 0


@pytest.mark.parametrize('estimator', ['kalman', 'modified_polar'])
def test_second_mode_notices_a_turn_and_follows_it(estimator: str) -> None:
    """The mode of a turn wins in the turn and only there; with a quiet mode alone it is lost."""
    time = PERIOD * np.arange(CYCLES)
    rate = 0.2 * DEGREE * ((time >= 120.0) & (time < 160.0))
    truth = (PERIOD * np.cumsum(rate))[:, None]
    messages = cycles(truth, false_marks=0.0)
    quiet = {'estimator': estimator, 'motion__bearing_noise': [1e-5], 'motion__rate_noise': [1e-6]}
    both = {
        'estimator': estimator, 'motion__bearing_noise': [1e-5, 1e-5],
        'motion__rate_noise': [1e-6, 1e-3], 'motion__sojourn_time': [600.0, 60.0],
    }  # fmt: skip
    trackers = [followed(messages[:looks], **both)[0] for looks in (60, 72, CYCLES)]
    turning = [tracker.tracks.planes[0].mode_probability[0, 1] for tracker in trackers]
    assert turning[0] < 0.2
    assert turning[1] > 0.5
    assert turning[2] < 0.2
    first = int(trackers[0].tracks.id[0])
    assert first in ids_near(followed(messages, **both)[1], truth)[0]
    assert first not in followed(messages, **quiet)[1][-1][0]


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'estimator': 'finite_memory', 'motion.bearing_noise': [1e-4, 1e-3],
          'motion.rate_noise': [1e-6, 1e-5], 'motion.sojourn_time': [600.0, 60.0]}, 'one mode'),
        ({'association': 'nearest', 'sensor.bearing_resolution': 0.04}, 'must be jpda'),
        ({'motion.bearing_noise': [1e-4, 1e-3]}, 'one value per mode'),
        ({'motion.bearing_noise': [1e-4, 1e-4], 'motion.rate_noise': [1e-5, 1e-6],
          'motion.sojourn_time': [60.0, 600.0]}, 'rate_noise must be least in the first mode'),
        ({'motion.range_min': 5000.0, 'motion.range_max': 1000.0}, 'must be below range_max'),
    ],
)  # fmt: skip
def test_config_refuses_what_does_not_fit(values, words: str) -> None:
    """Parameters that contradict each other are refused, with what would be right."""
    with pytest.raises(ValueError, match=words):
        with_values(SonarTrackerConfig(), values)


def test_one_unsure_mark_ends_no_track():
    """Three contacts in clutter, then a mark that tells an sd of half a radian."""
    messages = cycles(drifting((10.0, 0.01), (80.0, -0.01), (-60.0, 0.0)), false_marks=30.0)
    odd = messages[60]
    sd = np.full(len(odd.bearing), 0.3 * DEGREE)
    sd[-1] = 0.5
    messages[60] = replace(odd, bearing_sd=sd)
    _, seen = followed(messages, clutter_density=5.0)
    held = [len(ids) for ids, _ in seen[59:70]]
    assert min(held) >= 3


def test_linear_array_in_clutter_confirms_its_contacts():
    """Marks near the axis, which are blurred most, do not widen the gates of all."""
    messages = cycles(drifting((60.0, 0.01), (90.0, -0.01), (120.0, 0.0)), false_marks=30.0)
    values = {'sensor__array': 'linear', 'sensor__bearing_sd': 0.02}
    _, seen = followed(messages, clutter_density=5.0, **values)
    assert min(len(ids) for ids, _ in seen[60:]) >= 3
