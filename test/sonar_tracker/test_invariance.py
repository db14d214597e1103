# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What must not change tracks and ranges does not: where north is, which way round, when."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.ranging import RangeEstimates
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.platform import Platform
from tracking_core.rows import take

PERIOD, CYCLES, SPEED = 4.0, 170, 5.0  # [s], of own ship [m/s]
SD = np.radians(0.3)
PLACES = np.array([4000 + 3000j, -5000 + 2000j, 1000 - 6000j, -2000 - 4000j])  # [m]
VELOCITIES = np.array([-4, 3 + 3j, 2 - 4j, 3j])  # [m/s]
Cycles = tuple[Bearings, ...]


def platform(time, place, heading, velocity) -> Platform:
    """Return own ship at places (K,), x + iy [m], with headings (K,) [rad]."""
    flat = np.zeros(len(time))
    return Platform(
        time, np.stack([place.real, place.imag, flat], axis=1),
        np.stack([flat, flat, np.sin(0.5 * heading), np.cos(0.5 * heading)], axis=1),
        np.stack([velocity.real, velocity.imag, flat], axis=1),
        np.zeros((len(time), 3, 3)), flat,
    )  # fmt: skip


@cache
def scene() -> tuple[Cycles, Platform]:
    """Return what is heard of four contacts, with false marks, while own ship turns once."""
    rng, time = np.random.default_rng(4), PERIOD * np.arange(CYCLES)
    heading = np.radians(np.clip(time - 300.0, 0.0, 60.0))
    velocity = SPEED * np.exp(1j * heading)
    own = np.cumsum(velocity) * PERIOD
    cycles = []
    for k, now in enumerate(time.tolist()):
        line = (PLACES + VELOCITIES * now - own[k]) * np.exp(-1j * heading[k])
        heard = np.angle(line) + SD * rng.standard_normal(len(line))
        heard = np.append(heard[rng.random(len(line)) < 0.9], rng.uniform(-3, 3, rng.poisson(0.5)))
        cycles.append(replace(Bearings.of(np.full(len(heard), now), heard), stamp=now))
    return tuple(cycles), platform(time, own, heading, velocity)


def tracked(cycles: Cycles, own: Platform) -> tuple[SonarTracker, RangeEstimates]:
    """Return a tracker after these cycles, and the ranges of its tracks."""
    tracker = SonarTracker(with_values(SonarTrackerConfig(), {'sensor.bearing_sd': SD}))
    for cycle in cycles:
        tracker.track(cycle, own)
    return tracker, tracker.ranges()


def changed(turn=0.0, sense=1.0, epoch=0.0, moved=0j) -> tuple[Cycles, Platform]:
    """Return the scene in a world that is turned, mirrored, later or elsewhere."""
    cycles, own = scene()
    yaw = 2.0 * np.arctan2(own.orientation[:, 2], own.orientation[:, 3])

    def here(vector):
        return (vector[:, 0] + 1j * sense * vector[:, 1]) * np.exp(1j * turn)

    other = platform(
        own.time + epoch, here(own.position) + moved, sense * yaw + turn, here(own.velocity)
    )
    heard = (
        replace(m, bearing=sense * m.bearing, time=m.time + epoch, stamp=m.stamp + epoch)
        for m in cycles
    )
    return tuple(heard), other


CHANGES = {
    'turned': {'turn': 0.5 * np.pi},
    'turned round': {'turn': np.pi},
    'turned so that one crosses the seam': {'turn': 2.2},
    'mirrored': {'sense': -1.0},
    'of today': {'epoch': 1.7e9},
    'before the epoch': {'epoch': -100.0},
    'in UTM': {'moved': 5e5 + 6.5e6j},
}


@pytest.mark.parametrize('change', CHANGES.values(), ids=CHANGES)
def test_tracks_and_ranges_are_those_of_the_changed_world(change) -> None:
    """The same ids and looks, the same bearings there, the same ranges, speeds and courses."""
    (one, ranges), (other, there) = tracked(*scene()), tracked(*changed(**change))
    assert one.tracks.confirmed.sum() == len(PLACES)
    assert ranges.observable.sum() >= 3
    for name in ('id', 'hits', 'misses'):
        assert_array_equal(getattr(other.tracks, name), getattr(one.tracks, name))
    turn, sense = change.get('turn', 0.0), change.get('sense', 1.0)
    found, expected = bearing_states(other.tracks), bearing_states(one.tracks)
    apart = np.exp(1j * (found.bearing - sense * expected.bearing - turn))
    assert (np.abs(np.angle(apart)) < 0.01 * expected.bearing_sd).all()
    for name in ('range', 'range_sd', 'speed'):
        assert_allclose(getattr(there, name), getattr(ranges, name), rtol=1e-3)
    course = np.exp(1j * there.course) - np.exp(1j * (sense * ranges.course + turn))
    assert (np.abs(course[ranges.observable]) < 1e-3).all()


def test_order_of_marks_and_parameters_set_again_change_nothing() -> None:
    """Within a cycle marks are in any order; a parameter may be set to what it is."""
    (cycles, own), rng = scene(), np.random.default_rng(1)
    (one, ranges), other = tracked(cycles, own), tracked((), own)[0]
    for cycle in cycles:
        other.track(take(cycle, rng.permutation(len(cycle))), own)
        other.reconfigure(other.config)
    assert_array_equal(other.tracks.id, one.tracks.id)
    assert_allclose(other.ranges().range, ranges.range, rtol=1e-6)
