# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Scenario V-0: two contacts whose bearings cross keep their ids, although they make one mark."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from benchmarks.sonar_data import preset
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from studies.v0_crossing import kept, OURS, PAPER, RESOLUTION, run, SEED
from studies.v0_figures import AFTER, BEFORE
from studies.v0_scenes import truth
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

DEGREE = np.pi / 180.0


def test_scene_has_the_published_facts() -> None:
    """Separation 2.344 deg at 1000 s, crossing at 1332.6 s, near from 1047 to 1667 s."""
    time, bearing, _ = truth('nominal')
    compass = 90.0 - bearing / DEGREE
    apart = compass[:, 0] - compass[:, 1]
    assert apart[500] == pytest.approx(2.344, abs=0.005)
    assert np.interp(0.0, -apart, time) == pytest.approx(1332.6, abs=0.5)
    assert np.interp(1332.6, time, compass[:, 0]) == pytest.approx(75.43, abs=0.02)
    near = time[np.abs(apart) < 2.0]
    assert_allclose([near[0], near[-1]], [1047.0, 1667.0], atol=2.0)


@pytest.mark.slow
@pytest.mark.parametrize('name', ['nominal', 'fluct'])
@pytest.mark.parametrize('misjudged', [0.75, 1.0, 1.25])
def test_ids_are_kept_through_the_crossing(name: str, misjudged: float) -> None:
    """One run each; docs/results/voronina_2019.md has a hundred."""
    values = {**OURS, 'sensor.bearing_resolution': misjudged * RESOLUTION}
    one = run(name, SEED + 1, values)
    held, swapped = kept(one, BEFORE, AFTER)
    assert held.all()
    assert not swapped
    assert one.false == 0


@pytest.mark.slow
def test_contact_that_turns_towards_the_other_while_merged_keeps_its_id() -> None:
    """They stay one mark for fourteen minutes; neither is ended as the double of the other."""
    values = {**preset('passive_linear_array'), 'ranging.enabled': False}
    one = run('towards', SEED + 1, values)
    held, swapped = kept(one, BEFORE, AFTER)
    assert held.all()
    assert not swapped


@pytest.mark.slow
def test_printed_tracker_is_good_before_the_crossing_and_loses_there() -> None:
    """Both are held for the first 1000 s, not both get through the crossing."""
    one = run('nominal', SEED + 1, PAPER)
    assert ((one.id[:500] >= 0).mean(axis=0) > 0.98).all()
    assert not kept(one, BEFORE, AFTER)[0].all()


def test_contacts_that_cross_at_the_wrap_keep_their_ids() -> None:
    """All round sonar, marks merged below 3 degrees, crossing at +-pi."""
    rng, limit = np.random.default_rng(3), 3.0 * DEGREE
    values = {
        'sensor.bearing_sd': 0.2 * DEGREE, 'sensor.bearing_resolution': limit,
        'estimator': 'modified_polar', 'motion.bearing_noise': [1e-5],
        'motion.rate_noise': [1e-7], 'clutter_density': 0.1, 'ranging.enabled': False,
        'initiation.rate_max': 0.3 * DEGREE, 'initiation.rate_sd': 0.05 * DEGREE,
    }  # fmt: skip
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    ids = []
    for k in range(200):
        true = np.pi + np.array([-8.0 + 0.08 * k, 6.0 - 0.06 * k]) * DEGREE
        marks = true if abs(true[1] - true[0]) > limit else true.mean(keepdims=True)
        marks = wrap_angle(marks + rng.normal(0.0, 0.2 * DEGREE, len(marks)))
        tracks = tracker.track(Bearings.of(np.full(len(marks), 2.0 * k), marks))
        where = bearing_states(tracks).bearing
        off = np.abs(wrap_angle(where[:, None] - true)) + 9.0 * ~tracks.confirmed[:, None]
        ids.append(tracks.id[off.argmin(axis=0)] if len(tracks) else [0, 0])
    assert ids[40][0] != ids[40][1]
    assert list(ids[-1]) == list(ids[40])
    assert tracker.tracks.confirmed.sum() == 2


@pytest.mark.parametrize('seed', [1, 4])
def test_contacts_in_one_mark_outlive_blank_cycles(seed) -> None:
    """Two cross and give one mark; two cycles hear nothing of them: both keep their ids."""
    resolution, noise = 0.05, 0.005
    values = {'sensor.bearing_sd': noise, 'sensor.bearing_resolution': resolution}
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    rng, ids = np.random.default_rng(seed), []
    for k in range(300):
        apart = 6e-4 * 2.0 * (k - 150)
        true = np.array([0.5, 0.5 + apart])
        heard = true[rng.random(2) < 0.9] if abs(apart) > resolution else true.mean(keepdims=True)
        heard = heard[:0] if k in (155, 156) else heard
        marks = heard + rng.normal(0.0, noise, len(heard))
        marks = np.append(marks, rng.uniform(-np.pi, np.pi, rng.poisson(3)))
        time = np.full(len(marks), 2.0 * k)
        tracks = tracker.track(replace(Bearings.of(time, marks), stamp=2.0 * k))
        place, sure = tracks.planes[0].average[:, 0], tracks.confirmed
        if k in (80, 299):
            ids.append([tracks.id[sure][np.abs(place[sure] - b).argmin()] for b in true])
    assert ids[0] == ids[1]
