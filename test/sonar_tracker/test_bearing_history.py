# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Marks that are kept of each track: bounded, and without loss."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from sonar_tracker.bearing_history import BearingHistory
from tracking_core.linalg import wrap_angle


def filled(marks: int, K: int = 16, window: float = 1e6) -> BearingHistory:
    """Return the history of two tracks of this many marks on straight lines."""
    history = BearingHistory(K, window)
    history.follow(np.array([3, 8]))
    for k in range(marks):
        bearing = wrap_angle(np.array([3.0, -3.0]) + np.array([0.01, -0.02]) * k)
        own = np.array([[2.0 * k, 1.0], [5.0, -k]])
        history.add(np.arange(2), np.full(2, float(k)), bearing, np.full(2, 4.0), own)
    return history


def test_history_is_bounded_and_keeps_all_information() -> None:
    """A thousand marks in 16 rows: all weight is there, on the lines, across the wrap."""
    kept = filled(1000).read(np.arange(2))
    assert kept.time.shape == (2, 16)
    assert_allclose(kept.weight.sum(axis=1), 4000.0)
    assert_allclose(np.diff(kept.time[0, : kept.count[0]]) > 0.0, True)
    has = kept.weight > 0.0
    line = np.array([[3.0], [-3.0]]) + np.array([[0.01], [-0.02]]) * kept.time
    assert_allclose(wrap_angle(kept.bearing - line)[has], 0.0, atol=1e-9)
    assert_allclose(kept.own[0, has[0], 0], 2.0 * kept.time[0, has[0]])
    spans = kept.weight / 4.0
    assert spans.max() <= 8.0 * np.median(spans[has])


def test_history_forgets_what_is_older_than_the_window() -> None:
    """Only the last 50 s are told, whatever is still in the rows."""
    kept = filled(300, window=50.0).read(np.arange(2))
    has = kept.weight > 0.0
    assert kept.time[has].min() >= 299.0 - 50.0
    assert kept.weight.sum() >= 2 * 4.0 * 40.0


def test_history_follows_ids() -> None:
    """Rows go with the ids; a new id has no marks; a lost one is gone."""
    history = filled(5)
    history.follow(np.array([8, 9]))
    assert_array_equal(history.read(np.arange(2)).count, [5, 0])
    assert_array_equal(history.newest(), [4.0, -np.inf])
    history.follow(np.array([3, 8]))
    assert_array_equal(history.read(np.arange(2)).count, [0, 5])
    history.forget_older_half(np.array([1]))
    kept = history.read(np.array([1]))
    assert_array_equal(kept.time[kept.weight > 0.0], [2.0, 3.0, 4.0])


def test_history_keeps_the_turn_of_a_contact_that_passes_near() -> None:
    """Nine hundred marks in 128 rows, half a circle in half a minute: all are where it was."""
    history, sd, own = BearingHistory(128, 1e6), 0.01, np.zeros((1, 2))
    history.follow(np.array([1]))
    for time in 2.0 * np.arange(900):
        bearing = np.arctan2([100.0], [10.0 * (time - 900.0)])
        history.add(np.array([0]), np.array([time]), bearing, np.array([sd**-2]), own)
    kept = history.read(np.array([0]))
    true = np.arctan2(100.0, 10.0 * (kept.time - 900.0))
    off = wrap_angle(kept.bearing - true) * np.sqrt(kept.weight)
    assert np.abs(off).max() < 0.5
