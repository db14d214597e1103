# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are many small matrices inverted, symmetrised and summed at once?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Bools, Floats, Ints


def wrap_angle(angle: Floats) -> Floats:
    """Return the angle in [-pi, pi) [rad]."""
    return np.asarray((angle + np.pi) % (2.0 * np.pi) - np.pi)


def symmetrise(matrix: Floats) -> Floats:
    """Return the symmetric part of (..., n, n)."""
    return np.asarray(0.5 * (matrix + np.swapaxes(matrix, -1, -2)))


def inverse(matrix: Floats) -> tuple[Floats, Floats]:
    """
    Invert symmetric matrices of one to three rows in closed form.

    Parameters
    ----------
    matrix : (..., d, d) array, d = 1, 2 or 3
        Symmetric.

    Returns
    -------
    inverse : (..., d, d) array
    determinant : (...,) array

    """
    size = matrix.shape[-1]
    result = np.empty_like(matrix)
    if size == 1:
        determinant = matrix[..., 0, 0].copy()
        result[..., 0, 0] = 1.0 / determinant
        return result, determinant
    a, b, c = matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 1]
    if size == 2:
        determinant = a * c - b * b
        result[..., 0, 0], result[..., 1, 1] = c / determinant, a / determinant
        result[..., 0, 1] = result[..., 1, 0] = -b / determinant
        return result, determinant
    if size != 3:
        raise ValueError(f'inverse takes matrices of 1 to 3 rows, got {size}')
    e, f, g = matrix[..., 0, 2], matrix[..., 1, 2], matrix[..., 2, 2]
    aa, ab, ae = c * g - f * f, e * f - b * g, b * f - c * e
    determinant = a * aa + b * ab + e * ae
    result[..., 0, 0], result[..., 1, 1] = aa, a * g - e * e
    result[..., 2, 2] = a * c - b * b
    result[..., 0, 1] = result[..., 1, 0] = ab
    result[..., 0, 2] = result[..., 2, 0] = ae
    result[..., 1, 2] = result[..., 2, 1] = b * e - a * f
    result /= determinant[..., None, None]
    return result, determinant


def is_positive_definite(matrix: Floats) -> Bools:
    """Return for each (..., n, n) whether every leading minor is positive and finite."""
    finite = np.asarray(np.isfinite(matrix).all(axis=(-1, -2)))
    safe = np.where(finite[..., None, None], matrix, np.eye(matrix.shape[-1]))
    pivots, good = safe.copy(), np.asarray(finite)
    for k in range(matrix.shape[-1]):  # elimination: all pivots positive <=> positive definite
        pivot = pivots[..., k, k]
        good = good & (pivot > 0.0)
        safe_pivot = np.where(pivot > 0.0, pivot, 1.0)
        column = pivots[..., k + 1 :, k]
        pivots[..., k + 1 :, k + 1 :] -= (
            column[..., :, None] * column[..., None, :] / safe_pivot[..., None, None]
        )
    return np.asarray(good)


def sum_by_track(rows: Floats, track: Ints, tracks: int) -> Floats:
    """
    Sum the rows that belong to the same track.

    Parameters
    ----------
    rows : (P, ...) array
        What is summed.
    track : (P,) array
        Row of the result for each of `rows`, sorted.
    tracks : int
        T, the number of rows of the result.

    Returns
    -------
    (T, ...) array
        Zero for tracks without rows.

    """
    result = np.zeros((tracks, *rows.shape[1:]))
    if len(track):
        starts = np.flatnonzero(np.diff(track, prepend=-1))
        result[track[starts]] = np.add.reduceat(rows, starts, axis=0)
    return result
