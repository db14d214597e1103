# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Filters that keep the mark of the last look."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from sonar_tracker.marked import last_marks, Marked
from tracking_core.batches import Association, Measurement
from tracking_core.estimators import DecoupledKalman, FiniteMemory, MarkovJump, ModifiedPolar
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import RandomWalk

ONE_MODE = ModeChain((600.0,))
FILTERS = {
    'kalman': MarkovJump((RandomWalk(1e-4, 1e-5), RandomWalk(1e-3, 1e-4)), ModeChain((99.0, 9.0))),
    'kalman_decoupled': DecoupledKalman(RandomWalk(1e-4, 1e-5)),
    'finite_memory': FiniteMemory(8),
    'modified_polar': ModifiedPolar((1e-4,), (1e-6,), ONE_MODE, 1e-3, 1e-4, 1e-4),
}
every_filter = pytest.mark.parametrize('name', FILTERS)


def looked(estimator, chance: float = 0.9):
    """Return the plane of three tracks after a look: two marks, one mark, none."""
    mean = np.array([[0.1, 1e-4], [1.0, 0.0], [2.0, 0.0]])
    plane = estimator.start(mean, np.tile(np.diag([1e-4, 1e-8]), (3, 1, 1)))
    if hasattr(estimator, 'move_sensor'):
        plane = estimator.move_sensor(plane, np.zeros((3, 4)))
    plane = estimator.predict(plane, np.full(3, 2.0))
    track, H = np.array([0, 0, 1]), np.tile([[[1.0, 0.0]]], (3, 1, 1))
    value, R = np.array([[0.102], [0.108], [1.003]]), np.full((3, 1, 1), 1e-5)
    seen = estimator.innovate(plane, track, Measurement(value, H, R, np.zeros(3, np.int64)))
    shares = np.array([0.75, 0.25, 1.0]) * chance
    return estimator.update(
        plane, track, seen,
        Association(shares, np.array([1.0 - chance, 1.0 - chance, 1.0]), np.zeros(3, bool)),
    )  # fmt: skip


@every_filter
def test_marked_filter_is_the_filter(name: str) -> None:
    """The mark is kept beside the state and changes nothing."""
    bare, marked = looked(FILTERS[name]), looked(Marked(FILTERS[name]))
    assert_array_equal(marked.mean, bare.mean)
    assert_array_equal(marked.covariance, bare.covariance)
    assert_array_equal(marked.memory[:, :-2], bare.memory)


@every_filter
def test_marked_filter_keeps_the_weighted_mark(name: str) -> None:
    """Mean by association probability with its own variance, not the estimate."""
    bearing, weight = last_marks(looked(Marked(FILTERS[name])))
    assert_allclose(bearing[:2], [0.1035, 1.003], atol=1e-9)
    spread = 0.75 * 0.0015**2 + 0.25 * 0.0045**2
    assert_allclose(weight, [0.9 / (1e-5 + spread), 0.9 / 1e-5, 0.0], rtol=1e-6)
    unlikely = last_marks(looked(Marked(FILTERS[name]), chance=0.3))[1]
    assert_array_equal(unlikely, 0.0)


def test_marked_filter_leaves_common_marks_out() -> None:
    """A mark that follows the track by half is another contact's too: no data of this one."""
    estimator = Marked(FILTERS['kalman'])
    plane = estimator.start(np.zeros((1, 2)), np.diag([1e-4, 1e-8])[None])
    H, R = np.array([[[1.0, 0.0]]]), np.full((1, 1, 1), 1e-5)
    alone = estimator.innovate(
        plane, np.zeros(1, np.int64), Measurement(np.zeros((1, 1)), H, R, np.zeros(1, np.int64))
    )
    shared = replace(alone, cross_covariance=0.5 * alone.cross_covariance)
    sure = Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    for seen, has in ((alone, True), (shared, False)):
        updated = estimator.update(plane, np.zeros(1, np.int64), seen, sure)
        assert (last_marks(updated)[1][0] > 0.0) == has


def test_marked_filter_keeps_marks_at_their_own_time() -> None:
    """A mark from before the look is the track's own, however uncertain the rate makes it."""
    estimator, covariance = Marked(FILTERS['kalman']), np.array([[[1e-4, 8e-6], [8e-6, 1e-6]]])
    plane = estimator.start(np.array([[0.1, 1e-3]]), covariance)
    none, R = np.zeros(1, np.int64), np.full((1, 1, 1), 1e-5)
    H = np.array([[[1.0, -5.0]]])  # 5 s before it
    seen = estimator.innovate(plane, none, Measurement(np.array([[0.105]]), H, R, none))
    sure = Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    bearing, weight = last_marks(estimator.update(plane, none, seen, sure))
    assert_allclose(bearing, 0.105 + 5.0 * 1e-3)  # where the rate has it at the look
    assert_allclose(weight, 1e5)
