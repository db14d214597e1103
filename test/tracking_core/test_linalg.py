# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Many small matrices at once."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from tracking_core.linalg import (
    inverse,
    is_positive_definite,
    over_modes,
    sum_by_track,
    symmetrise,
    wrap_angle,
)


def covariances(size: int, count: int = 200, seed: int = 1):
    """Random positive definite matrices of very different scale."""
    rng = np.random.default_rng(seed)
    root = rng.normal(0.0, 1.0, (count, size, size)) * np.exp(rng.normal(0.0, 3.0, (count, 1, 1)))
    return root @ np.swapaxes(root, 1, 2) + 1e-3 * np.abs(root).max(axis=(1, 2))[
        :, None, None
    ] ** 2 * np.eye(size)


@pytest.mark.parametrize('size', [1, 2, 3, 4, 6])
def test_inverse_equals_lapack(size: int) -> None:
    """Inverse and determinant, in closed form up to three rows."""
    matrix = covariances(size)
    result, determinant = inverse(matrix)
    assert_allclose(result @ matrix, np.tile(np.eye(size), (len(matrix), 1, 1)), atol=1e-8)
    assert_allclose(determinant, np.linalg.det(matrix), rtol=1e-9)


@pytest.mark.parametrize('size', [1, 2, 4, 6])
def test_is_positive_definite_says_what_eigenvalues_say(size: int) -> None:
    """Definite, indefinite, singular and not finite ones."""
    matrix = covariances(size)
    assert is_positive_definite(matrix).all()
    values, vectors = np.linalg.eigh(matrix)
    values[:, 0] *= -0.5
    assert not is_positive_definite((vectors * values[:, None]) @ np.swapaxes(vectors, 1, 2)).any()
    matrix[0, 0, 0] = np.nan
    matrix[1, 0, -1] = np.inf
    matrix[2] = 0.0
    assert_array_equal(is_positive_definite(matrix[:4]), [False, False, False, True])


def test_symmetrise_is_the_symmetric_part() -> None:
    """Half of matrix and transpose."""
    assert_array_equal(symmetrise(np.array([[1.0, 2.0], [4.0, 3.0]])), [[1.0, 3.0], [3.0, 3.0]])


def test_wrap_angle_is_half_open() -> None:
    """In [-pi, pi), the same direction."""
    angle = np.array([np.pi, -np.pi, 3.0 * np.pi, 0.5 - 8.0 * np.pi])
    assert_allclose(wrap_angle(angle), [-np.pi, -np.pi, -np.pi, 0.5], atol=1e-12)


@pytest.mark.parametrize('tracks', [7, 400, 2000])
def test_sum_by_track_equals_adding_row_by_row(tracks: int) -> None:
    """Oracle: one addition after the other; few tracks and many are summed in different ways."""
    rng = np.random.default_rng(tracks)
    track, rows = np.sort(rng.integers(0, tracks, 300)), rng.random((300, 2, 3))
    expected = np.zeros((tracks, 2, 3))
    np.add.at(expected, track, rows)
    # Of up to 43 numbers below 1 in another order.
    assert_allclose(sum_by_track(rows, track, tracks), expected, rtol=0.0, atol=1e-12)


def test_sum_by_track_leaves_out_nobody() -> None:
    """Tracks without rows have zero; no rows at all is legal."""
    values = np.arange(8.0).reshape(4, 2)
    track = np.array([1, 1, 3, 4])
    expected = [[0.0, 0.0], [2.0, 4.0], [0.0, 0.0], [4.0, 5.0], [6.0, 7.0], [0.0, 0.0]]
    assert_array_equal(sum_by_track(values, track, 6), expected)
    assert_array_equal(sum_by_track(values[:0], track[:0], 2), np.zeros((2, 2)))


def test_over_modes_equals_the_reduction_of_numpy() -> None:
    """One mode or more, with and without further axes, and no rows at all."""
    rng = np.random.default_rng(1)
    for shape in ((5, 3), (5, 1), (0, 2), (4, 2, 3)):
        values = rng.normal(size=shape)
        for join in (np.add, np.maximum, np.minimum):
            assert_allclose(over_modes(join, values), join.reduce(values, axis=1))


@pytest.mark.parametrize('size', [1, 2, 3, 4])
def test_inverse_of_what_rounding_left_singular_is_nothing(size: int) -> None:
    """No number and no error of it spoils the others; the determinant says which it is."""
    good, flat = np.diag(np.arange(2.0, 2.0 + size)), np.zeros((size, size))
    worse = good - 4.0 * np.eye(size) * np.eye(size)[0]
    inverted, determinant = inverse(np.stack([good, flat, worse]))
    assert_allclose(inverted, [np.linalg.inv(good), flat, flat], atol=1e-15)
    assert (np.sign(determinant) == [1.0, 0.0, -1.0]).all()
