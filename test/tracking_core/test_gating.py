# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Sweep and grid find the same pairs as looking at all of them."""

from __future__ import annotations

from unittest.mock import patch

from hypothesis import example, given, settings, strategies
import numpy as np
from numpy.testing import assert_array_equal
import pytest

from tracking_core import gating
from tracking_core.gating import box_pairs, sector_pairs


def brute_force(centre, half_size, plots):
    """Look at every track with every plot."""
    gap = np.abs(plots[None] - centre[:, None])
    return np.nonzero((gap <= half_size[:, None]).all(axis=2))


@settings(max_examples=200)
@given(
    seed=strategies.integers(0, 2**32 - 1),
    tracks=strategies.integers(0, 30),
    plots=strategies.integers(0, 60),
    dimensions=strategies.sampled_from([1, 2, 3]),
    size=strategies.sampled_from([0.0, 0.01, 1.0, 30.0, 1e4]),
    grid=strategies.booleans(),
    way=strategies.sampled_from([(10_000, 10_000), (0, 10_000), (0, 0)]),  # all, a sweep, cells
    at_once=strategies.sampled_from([1, 30, 10_000]),
)
@example(61, 3, 45, 2, 1e4, False, (0, 0), 10_000)  # the rightmost plot
def test_box_pairs_equals_brute_force(
    seed, tracks, plots, dimensions, size, grid, way, at_once
) -> None:
    """Any sizes, boxes from points to everything, also with plots on common lines."""
    rng = np.random.default_rng(seed)
    centre = rng.normal(0.0, 10.0, (tracks, dimensions))
    where = rng.normal(0.0, 10.0, (plots, dimensions))
    if grid:
        centre, where = np.round(centre), np.round(where)
    half_size = size * rng.exponential(1.0, (tracks, dimensions))
    with patch.multiple(gating, _FEW=way[0], _MANY=way[1], _AT_ONCE=at_once):
        found = box_pairs(centre, half_size, where)
    for ours, expected in zip(found, brute_force(centre, half_size, where), strict=True):
        assert_array_equal(ours, expected)


@pytest.mark.parametrize('way', [(0, 10**9), (0, 0)], ids=['a sweep', 'cells'])
def test_box_pairs_looks_at_no_more_than_allowed(way: tuple[int, int]) -> None:
    """The first boxes are filled, those beyond the bound stay empty and cost nothing."""
    rng = np.random.default_rng(4)
    centre, plots = rng.normal(0.0, 1.0, (300, 2)), rng.normal(0.0, 1.0, (400, 2))
    with (
        patch.multiple(gating, _FEW=way[0], _MANY=way[1], _AT_ONCE=100),
        patch.object(gating, '_inside', wraps=gating._inside) as inside,
    ):
        track, plot = box_pairs(centre, np.full((300, 2), 20.0), plots, most=2_000)
    assert_array_equal(track, np.repeat(np.arange(5), 400))
    assert_array_equal(plot, np.tile(np.arange(400), 5))
    assert inside.call_count <= 21


def test_box_pairs_ignores_a_coordinate_that_is_not_measured() -> None:
    """A plot without height is in the box of the two coordinates it has."""
    plots = np.array([[1.0, 1.0, np.nan], [9.0, 9.0, np.nan]])
    track, plot = box_pairs(np.zeros((1, 3)), np.full((1, 3), 2.0), plots)
    assert_array_equal(track, [0])
    assert_array_equal(plot, [0])


def test_box_pairs_finds_what_a_million_candidates_hide() -> None:
    """Far from the origin, in rows that are nearly all empty."""
    rng = np.random.default_rng(2)
    plots = rng.uniform(-1e5, 1e5, (3000, 2)) + 1e7
    centre = plots[rng.permutation(3000)[:1000]] + rng.normal(0.0, 100.0, (1000, 2))
    half_size = rng.uniform(10.0, 500.0, (1000, 2))
    found = box_pairs(centre, half_size, plots)
    assert len(found[0]) > 500
    for ours, expected in zip(found, brute_force(centre, half_size, plots), strict=True):
        assert_array_equal(ours, expected)


def test_sector_pairs_equal_a_comparison_of_all() -> None:
    """Angles given with any number of turns, sectors up to all round, NaN is in none."""
    rng = np.random.default_rng(3)
    centre, half = rng.uniform(-9.0, 9.0, (60, 1)), rng.exponential(0.5, (60, 1))
    plots = rng.uniform(-9.0, 9.0, (80, 1))
    plots[7] = np.nan
    half[3] = 10.0
    apart = np.abs((plots[None, :, 0] - centre[:, None, 0] + np.pi) % (2.0 * np.pi) - np.pi)
    expected = np.argwhere(apart <= half)
    assert_array_equal(np.stack(sector_pairs(centre, half, plots), axis=1), expected)
    assert len(sector_pairs(centre[:0], half[:0], plots)[0]) == 0
    assert len(sector_pairs(centre, half, plots[:0])[0]) == 0
