# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are consistency, switches and purity those of FilterPy and nrl-tracker?"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_tools.scoring import continuity, match, Stretches, track_error
from tracking_tools.scoring.accuracy import normalised
from tracking_tools.scoring.consistency import consistency

theirs = pytest.importorskip('pytcl.performance_evaluation', reason='nrl-tracker (extra peers)')
filterpy = pytest.importorskip('filterpy.stats', reason='FilterPy (extra peers)')

SCANS, RADIUS = 30, 25.0  # as in random_scene
TOLERANCE = 1e-9


@pytest.fixture(params=range(5))
def matched(request: pytest.FixtureRequest, random_scene: Any) -> Any:
    """Return rows, their matches and the stretches of one random scene."""
    rows, truth = random_scene(request.param)
    stretches = Stretches.of_truth(truth, np.arange(SCANS + 1.0))
    return rows, match(rows, truth, RADIUS), stretches


def test_nees_is_that_of_both(matched: Any) -> None:
    """Each square, and the mean of a recording; NIS is the same formula of innovations."""
    rows, matches, _ = matched
    real = np.concatenate([matches.position, matches.velocity], axis=1)
    said = np.concatenate([rows.position, rows.velocity], axis=1)[matches.row]
    P = rows.covariance[matches.row]
    ours = normalised(said - real, P)
    assert_allclose(ours, theirs.nees_sequence(real, said, P), rtol=TOLERANCE)
    assert_allclose(ours, filterpy.NEES(real, said, P), rtol=TOLERANCE)
    error = track_error(rows, matches)
    assert_allclose(error.nees_state, theirs.average_nees(real, said, P) / 4, rtol=TOLERANCE)
    place = theirs.average_nees(real[:, :2], said[:, :2], P[:, :2, :2]) / 2
    assert_allclose(error.nees_position, place, rtol=TOLERANCE)


@pytest.mark.parametrize(('size', 'dimensions'), [(1, 1), (7, 2), (500, 4), (40_000, 6)])
def test_band_of_the_mean_is_that_of_nrl_tracker(size: int, dimensions: int) -> None:
    """Mean, band and verdict of a chi-square test; share within the 95 % quantile."""
    rng = np.random.default_rng(size)
    P = np.broadcast_to(np.eye(dimensions), (size, dimensions, dimensions))
    error = rng.normal(0.0, 1.0, (size, dimensions))
    squares = (error**2).sum(axis=1)
    ours, their = consistency(squares, dimensions), theirs.consistency_test(squares, dimensions)
    limits = np.array([their.mean_value, their.lower_bound, their.upper_bound]) / dimensions
    assert_allclose([ours.mean, ours.low, ours.high], limits, rtol=TOLERANCE)
    assert ours.is_inside == their.is_consistent
    assert ours.inside == theirs.credibility_interval(error, P)


def test_switches_and_purity_are_those_of_nrl_tracker(matched: Any) -> None:
    """Every contact is there without a gap, so all their fragmentations are our switches."""
    rows, matches, stretches = matched
    mixed = replace(matches, track=matches.track // 20)  # two contacts share an id
    for one in (matches, mixed):
        ours = continuity(rows, one, np.unique(one.track), stretches)
        labels = one.contact, one.track
        assert ours.switches == theirs.track_fragmentation(*labels, one.scan)
        assert ours.switches > 0
        assert_allclose(ours.purity, theirs.track_purity(*labels), rtol=TOLERANCE)
    assert ours.purity < 0.8
