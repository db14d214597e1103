# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are many small matrices inverted, symmetrised and summed at once?"""

from __future__ import annotations

from functools import reduce
import math

import numpy as np

from tracking_core.batches import Bools, Floats, Ints

TURN = 2.0 * np.pi  # a whole one [rad]


def wrap_angle(angle: Floats) -> Floats:
    """Return the angle in [-pi, pi) [rad]."""
    return np.asarray((angle + np.pi) % TURN - np.pi)


def nearest_turn(angle: Floats, reference: Floats) -> Floats:
    """Return the angle, whole turns added, that is nearest to the reference [rad]."""
    return np.asarray(reference + wrap_angle(angle - reference))


def symmetrise(matrix: Floats) -> Floats:
    """Return the symmetric part of (..., n, n)."""
    total = np.add(matrix, matrix.swapaxes(-1, -2), order='F')
    total *= 0.5
    return np.asarray(total)


def determinant(matrix: Floats) -> Floats:
    """Return the determinants of symmetric (..., d, d), d up to 3 in closed form."""
    size = matrix.shape[-1]
    if size == 1:
        return matrix[..., 0, 0]
    a, b, c = matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 1]
    if size == 2:
        return np.asarray(a * c - b * b)
    if size > 3:
        return np.asarray(np.linalg.det(matrix))
    e, f, g = matrix[..., 0, 2], matrix[..., 1, 2], matrix[..., 2, 2]
    return np.asarray(a * (c * g - f * f) + b * (e * f - b * g) + e * (b * f - c * e))


def inverse(matrix: Floats) -> tuple[Floats, Floats]:
    """
    Invert covariances, those of one to three rows in closed form.

    Parameters
    ----------
    matrix : (..., d, d) array
        Symmetric.

    Returns
    -------
    inverse : (..., d, d) array
        0 where the determinant is not positive, as rounding may leave it: it cannot be told.
    determinant : (...,) array

    """
    size = matrix.shape[-1]
    if size > 3:
        return _inverse_of_large(matrix)
    result = np.empty_like(matrix)
    if size == 1:
        determinant = matrix[..., 0, 0].copy()
        result[..., 0, 0] = 1.0 / _divisor(determinant)
        return result, determinant
    a, b, c = matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 1]
    if size == 2:
        determinant = a * c - b * b
        result[..., 0, 0], result[..., 1, 1] = c, a
        result[..., 0, 1] = result[..., 1, 0] = -b
        result /= _divisor(determinant)[..., None, None]
        return result, determinant
    e, f, g = matrix[..., 0, 2], matrix[..., 1, 2], matrix[..., 2, 2]
    aa, ab, ae = c * g - f * f, e * f - b * g, b * f - c * e
    determinant = a * aa + b * ab + e * ae
    result[..., 0, 0], result[..., 1, 1] = aa, a * g - e * e
    result[..., 2, 2] = a * c - b * b
    result[..., 0, 1] = result[..., 1, 0] = ab
    result[..., 0, 2] = result[..., 2, 0] = ae
    result[..., 1, 2] = result[..., 2, 1] = b * e - a * f
    result /= _divisor(determinant)[..., None, None]
    return result, determinant


def _divisor(determinant: Floats) -> Floats:
    sound = determinant > 0.0
    return determinant if sound.all() else np.where(sound, determinant, np.inf)


def _inverse_of_large(matrix: Floats) -> tuple[Floats, Floats]:
    determinant = np.asarray(np.linalg.det(matrix))
    sound = (determinant > 0.0)[..., None, None]
    inverted = np.linalg.inv(np.where(sound, matrix, np.eye(matrix.shape[-1])))
    return np.where(sound, inverted, 0.0), determinant


def is_positive_definite(matrix: Floats) -> Bools:
    """Return for each symmetric (..., n, n) whether every pivot is positive and finite."""
    rest = matrix.T
    least = most = rest[0, 0]  # of the pivots; NaN stays
    with np.errstate(all='ignore'):  # of those that are not
        while len(rest) > 1:
            rest = rest[1:, 1:] - rest[1:, None, 0] * (rest[None, 0, 1:] / rest[0, 0])
            least, most = np.minimum(least, rest[0, 0]), np.maximum(most, rest[0, 0])
    return np.asarray(((least > 0.0) & (most < np.inf)).T)


def over_modes(join: np.ufunc, values: Floats) -> Floats:
    """Return values (T, J, ...) joined over the modes; numpy itself is slow where J is small."""
    return np.asarray(reduce(join, values.swapaxes(0, 1)))


def sum_by_track(rows: Floats, track: Ints, tracks: int) -> Floats:
    """
    Sum the rows that belong to the same track.

    Parameters
    ----------
    rows : (P, ...) array
        What is summed.
    track : (P,) array
        Row of the result for each of `rows`.
    tracks : int
        T, the number of rows of the result.

    Returns
    -------
    (T, ...) array
        Zero for tracks without rows.

    """
    if rows.ndim == 1:
        return np.asarray(np.bincount(track, rows, tracks), np.float64)
    columns = math.prod(rows.shape[1:])
    place = track + tracks * np.arange(columns)[:, None]  # of all columns, in one count
    total = np.bincount(place.reshape(-1), rows.T.reshape(-1), columns * tracks)
    return np.asarray(total.reshape(*rows.shape[:0:-1], tracks).T, np.float64)


def first_rows(label: Ints) -> Ints:
    """Return the first row (L,) of each of L labels that stand in order in (P,), P > 0."""
    is_first = np.empty(len(label), np.bool_)
    is_first[0] = True
    np.not_equal(label[1:], label[:-1], out=is_first[1:])
    return is_first.nonzero()[0]
