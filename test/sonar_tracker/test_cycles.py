# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A cycle that comes in several messages, as one bearing each, is tracked as in one."""

from __future__ import annotations

from dataclasses import replace
import logging

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from msg_adapters.table import from_columns
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.cycles import Cycles
from tracking_core.rows import take

typesys = pytest.importorskip('rosbags.typesys')
STORE = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
message_types = pytest.importorskip('msg_adapters.message_types')
TYPES = message_types.rosbags_types()
PERIOD, CYCLES, CONTACTS, SD = 2.0, 60, 5, 0.005  # [s], [rad]


def whole(number: int) -> Bearings:
    """Return the marks of a cycle: of five contacts, not all of them, and a false one."""
    rng = np.random.default_rng(number)
    bearing = np.arange(CONTACTS) - 2.0 + SD * rng.standard_normal(CONTACTS)
    bearing = np.append(bearing[rng.random(CONTACTS) < 0.9], rng.uniform(-np.pi, np.pi))
    stamp = 1000.0 + PERIOD * number
    marks = Bearings.of(np.full(len(bearing), stamp), bearing)
    return replace(marks, bearing_sd=np.full(len(bearing), SD), stamp=stamp)


def parts(marks: Bearings, step: float) -> list[Bearings]:
    """Return messages of one mark each, a step of time apart [s]."""
    single = [take(marks, slice(k, k + 1)) for k in range(len(marks))]
    return [replace(one, stamp=one.stamp + step * k) for k, one in enumerate(single)]


def tracker(period: float = 0.0) -> SonarTracker:
    """Return a tracker whose cycles come in parts, or whole ones."""
    return SonarTracker(with_values(SonarTrackerConfig(), {'scan.period': period}))


def test_cycles_of_one_bearing_each_have_the_tracks_of_whole_ones() -> None:
    """Taken for cycles of their own they would have none; a cycle is used when the next begins."""
    one, other = tracker(), tracker(0.9 * PERIOD)
    for number in range(CYCLES):
        if number < CYCLES - 1:
            one.track(whole(number))
        for part in parts(whole(number), 0.2):
            other.track(part)
    assert one.tracks.confirmed.sum() == CONTACTS
    assert_array_equal(other.tracks.id, one.tracks.id)
    found, expected = (bearing_states(t.tracks).bearing for t in (other, one))
    assert_allclose(found, expected, atol=1e-9)


def test_a_cycle_is_never_larger_than_a_message_may_be() -> None:
    """With stamps that do not go on it is over when it is full."""
    cycles, marks = Cycles(PERIOD, most=3), take(whole(0), slice(0, 1))
    found = [cycles.add(marks) for _ in range(7)]
    assert [0 if cycle is None else len(cycle) for cycle in found] == [0, 0, 0, 3, 0, 0, 3]


def test_going_back_takes_back_parts() -> None:
    """What was collected after a moment that is gone back to is not there."""
    late = tracker(0.9 * PERIOD)
    first, second, *_ = parts(whole(0), 0.2)
    late.track(first)
    memory = late.save()
    late.track(second)
    late.restore(memory)
    late.track(whole(1))
    assert late.state.report.plots == 1


def session(**values):
    """Return a session of a sonar."""
    config = with_values(SonarTrackerConfig(), values)
    return sonar_session(config, sonar_node_config(), TYPES, logging.getLogger('session'))


def arrival(bearing: float, stamp: float):
    """Return a direction of arrival."""
    z, w = np.sin(0.5 * bearing), np.cos(0.5 * bearing)
    covariance = np.zeros(36)
    covariance[35] = SD**2
    pose = TYPES.Pose(
        position=TYPES.Point(x=0.0, y=0.0, z=0.0),
        orientation=TYPES.Quaternion(x=0.0, y=0.0, z=z, w=w),
    )
    return STORE.types['geometry_msgs/msg/PoseWithCovarianceStamped'](
        header=TYPES.header(stamp, 'sonar'),
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=covariance),
    )


def test_bearings_of_one_stamp_are_one_cycle_and_one_table() -> None:
    """One after another under the stamp of their cycle; tables have stamps that rise."""
    sonar, stamps = session(**{'scan.period': 0.9 * PERIOD}), []
    for number in range(CYCLES):
        for bearing in whole(number).bearing.tolist():
            table = sonar.plots(arrival(bearing, whole(number).stamp), 0.0)
            if table is not None:
                stamps.append(table.header.stamp.sec)
    assert sonar.tracks.confirmed.sum() == CONTACTS
    assert not sonar.counts['bearings'].refused
    assert (np.diff(stamps) > 0).all()
    assert len(stamps) == CYCLES - 1


def test_single_bearings_are_said_to_need_a_period(caplog) -> None:
    """Once, and only of a type that cannot hold several, and where no period is set."""
    lines = []
    for msg, values in (
        (arrival(0.3, 1000.0), {}),
        (arrival(0.3, 1000.0), {'scan.period': PERIOD}),
        (from_columns({'bearing': np.zeros(1)}, 1000.0, 'sonar', TYPES), {}),
    ):
        caplog.clear()
        session(**values).plots(msg, 0.0)
        lines.append('set scan.period' in caplog.text)
    assert lines == [True, False, False]
