# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts that stay at one bearing for minutes, each with a mark, keep their tracks."""

from __future__ import annotations

import numpy as np
import pytest

from sonar_tracker.build import build_setup
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.sensor import Sonar
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

DEGREE = np.pi / 180.0
PERIOD = 2.0
TIME = np.arange(0.0, 1200.0, PERIOD)
# Ten degrees apart, at one bearing from 300 s to 900 s, and apart again.
APART = np.interp(TIME, [0.0, 300.0, 900.0, 1200.0], [10.0, 0.0, 0.0, 10.0]) * DEGREE


def ids_of_two(association: str, seed: int) -> tuple[float, set[int]]:
    """Return how many confirmed tracks there were on average, and all their ids."""
    rng = np.random.default_rng(seed)
    tracker = SonarTracker(with_values(SonarTrackerConfig(), {'association': association}))
    ids, held = set(), []
    for time, apart in zip(TIME, APART, strict=True):
        true = np.array([1.0, 1.0 + apart])[rng.random(2) < 0.9]
        marks = np.append(true + 0.5 * DEGREE * rng.standard_normal(len(true)),
                          rng.uniform(-np.pi, np.pi, rng.poisson(0.5)))  # fmt: skip
        tracks = tracker.track(Bearings.of(np.full(len(marks), time), wrap_angle(marks)))
        near = np.abs(wrap_angle(bearing_states(tracks).bearing - 1.0 - 0.5 * apart)) < 0.2
        here = tracks.id[tracks.confirmed & near]
        ids |= set(here.tolist())
        held.append(len(here))
    return float(np.mean(held[30:])), ids


@pytest.mark.parametrize('association', ['jpda', 'global_nearest'])
@pytest.mark.parametrize('seed', [1, 2, 3])
def test_contacts_at_one_bearing_keep_their_tracks(association: str, seed: int) -> None:
    """Two marks a cycle are two contacts; that one ended as the other's double cost seven ids."""
    held, ids = ids_of_two(association, seed)
    assert held == pytest.approx(2.0, abs=0.02)
    assert len(ids) == 2


@pytest.mark.parametrize(
    ('values', 'is_own'),
    [
        ({}, True),
        ({'association': 'nearest'}, True),
        ({'association': 'pda'}, False),
        ({'sensor.bearing_resolution': 0.02}, False),
    ],
)
def test_marks_may_be_shared_by_pda_and_below_the_resolution(values, is_own: bool) -> None:
    """Then two tracks with a mark each may be of one contact."""
    config = with_values(SonarTrackerConfig(), values)
    assert build_setup(config, Sonar(config.sensor)).has_own_plots is is_own
