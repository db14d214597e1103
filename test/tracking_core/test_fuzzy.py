# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Fuzzy inference against a slow one written rule by rule."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.fuzzy import FuzzySets, KHACHATUROV, Rules

VALUES = np.linspace(0.0, 10.0, 21)


def triangle(x: float, peaks: tuple[float, ...], i: int) -> float:
    """Membership in set i, by hand."""
    if x <= peaks[0]:
        return float(i == 0)
    if x >= peaks[-1]:
        return float(i == len(peaks) - 1)
    for k in range(len(peaks) - 1):
        if peaks[k] <= x <= peaks[k + 1]:
            up = (x - peaks[k]) / (peaks[k + 1] - peaks[k])
            return {k: 1.0 - up, k + 1: up}.get(i, 0.0)
    raise AssertionError


def slow(rules: Rules, before: float, now: float) -> float:
    """Min of the conditions, max over the rules, centre of area on a fine grid."""
    c, w = rules.condition.peaks, rules.conclusion.peaks
    grid = np.linspace(w[0], w[-1], 2001)
    area = np.zeros_like(grid)
    for i, row in enumerate(rules.table):
        for j, said in enumerate(row):
            strength = min(triangle(before, c, i), triangle(now, c, j))
            cut = [min(strength, triangle(x, w, said)) for x in grid]
            area = np.maximum(area, cut)
    return float((area @ grid) / area.sum())


def test_infer_equals_the_rules_one_by_one() -> None:
    """Random pairs of innovations; the grid is good to 1e-3 of the range."""
    rng = np.random.default_rng(2)
    before, now = rng.uniform(0.0, 9.0, (2, 12))
    expected = [slow(KHACHATUROV, *pair) for pair in zip(before, now, strict=True)]
    assert_allclose(KHACHATUROV.infer(before, now), expected, atol=1e-3)


def test_membership_is_a_partition() -> None:
    """Memberships of every value sum to 1, at a peak to one set alone."""
    sets = KHACHATUROV.condition
    assert_allclose(sets.membership(VALUES).sum(axis=-1), 1.0)
    assert_allclose(sets.membership(np.array(sets.peaks)), np.eye(4))


def test_minimum_over_all_memberships_is_zero() -> None:
    """Print (5) of [KHACH02]: the minimum over all sets is 0 for every value, hence no rule."""
    assert (KHACHATUROV.condition.membership(VALUES).min(axis=-1) == 0.0).all()


@pytest.mark.parametrize('before', range(4))
@pytest.mark.parametrize('now', range(4))
def test_infer_gives_the_centre_of_the_set_in_the_table(before: int, now: int) -> None:
    """At the peaks one rule holds alone."""
    centres = (0.2 / 3.0, 0.7 / 3.0, 1.7 / 3.0, 2.5 / 3.0)  # of the triangles
    peaks = KHACHATUROV.condition.peaks
    expected = centres[KHACHATUROV.table[before][now]]
    got = KHACHATUROV.infer(np.array([peaks[before]]), np.array([peaks[now]]))
    assert_allclose(got, expected, atol=2e-4)


def test_infer_rises_with_the_innovation_now_and_takes_empty_batches() -> None:
    """A larger innovation never means a smaller raise by more than the sets' overlap allows."""
    got = KHACHATUROV.infer(np.zeros(21), VALUES)
    assert got[-1] > 0.8 > got[0]
    assert (np.diff(got) > -0.05).all()
    assert KHACHATUROV.infer(np.zeros(0), np.zeros(0)).shape == (0,)


@pytest.mark.parametrize(
    ('table', 'match'),
    [(((0, 1),), 'table of rules must be 2 x 2'), (((0, 1), (1, 5)), 'conclude sets 0 to 1')],
)
def test_rules_that_do_not_fit_are_refused(table, match: str) -> None:
    """Shape and numbers of the table are checked."""
    with pytest.raises(ValueError, match=match):
        Rules(FuzzySets((0.0, 1.0)), FuzzySets((0.0, 1.0)), table)


def test_peaks_must_rise() -> None:
    """Sets in order."""
    with pytest.raises(ValueError, match='two or more, rising'):
        FuzzySets((0.0, 2.0, 2.0))
