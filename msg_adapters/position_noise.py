# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How sure is a message of its Cartesian plots? Covariances as columns, and back as matrices."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from msg_adapters.fields import COVARIANCE
from msg_adapters.table import Columns
from tracking_core.batches import Bools, Floats

LIMITS = (1e-6, 1e10)  # of a variance [m^2]
LEAST = 1e-9  # eigenvalue of a correlation matrix that is still one
_NAMES = {*COVARIANCE, 'x_sd', 'y_sd', 'z_sd'}
_PLACES = np.triu_indices(3)  # of the columns in a matrix
_IN_SIX = np.array([0, 1, 2, 7, 8, 14])  # of the same in a row-major 6 x 6 covariance


def covariance_columns(covariances: Sequence[object]) -> Columns:
    """Return one column (M,) for each element, from 6 x 6 covariances of poses; 0: not told."""
    full = np.array(covariances, np.float64).reshape(-1, 36)[:, _IN_SIX]
    return dict(zip(COVARIANCE, full.T, strict=True))


def position_covariance(read: Mapping[str, Floats], rows: int) -> tuple[Floats, int]:
    """
    Return the covariance of each plot (M, 3, 3) [m^2], and how many could not be true.

    Parameters
    ----------
    read : mapping of (M,) arrays
        Of `covariance_xx` ... `covariance_zz` and `x_sd`, `y_sd`, `z_sd` what the message has.
    rows : int
        M.

    Returns
    -------
    covariance : (M, 3, 3) array
        All NaN where nothing is told; of a plot with sure x and y and unknown z, NaN at z, z.
    odd : int
        Rows that tell one, but no covariance.

    """
    matrix = np.full((rows, 3, 3), np.nan)
    if not read.keys() & _NAMES:
        return matrix, 0
    for axis, name in enumerate('xyz'):
        matrix[:, axis, axis] = _variance(read, name)
    for column, one, other in zip(COVARIANCE, *_PLACES, strict=True):
        if one != other:
            matrix[:, one, other] = matrix[:, other, one] = read.get(column, 0.0)
    flat = ~_is_variance(matrix[:, 2, 2])
    matrix[flat, 2, :], matrix[flat, :, 2], matrix[flat, 2, 2] = 0.0, 0.0, np.nan
    good = _is_covariance(matrix, flat)
    told = np.nan_to_num(matrix[:, [0, 1], [0, 1]]).any(axis=1)
    matrix[~good] = np.nan
    return matrix, int(np.sum(told & ~good))


def _variance(read: Mapping[str, Floats], axis: str) -> Floats:
    """Return the variance (M,), or one NaN if the message has no column for it."""
    nothing = np.array(np.nan)
    variance, sd = read.get(f'covariance_{axis * 2}', nothing), read.get(f'{axis}_sd', nothing)
    with np.errstate(over='ignore'):
        return np.where(np.isnan(variance), sd**2, variance)


def _is_variance(values: Floats) -> Bools:
    return np.asarray((values >= LIMITS[0]) & (values <= LIMITS[1]))


def _is_covariance(matrix: Floats, flat: Bools) -> Bools:
    """Return which are positive definite, without z where that is `flat`."""
    good = _is_variance(matrix[:, 0, 0]) & _is_variance(matrix[:, 1, 1])
    filled = np.where(good[:, None, None], matrix, np.eye(3))
    filled[flat, 2, 2] = 1.0
    sd = np.sqrt(np.einsum('mii->mi', filled))
    with np.errstate(over='ignore'):
        correlation = filled / (sd[:, :, None] * sd[:, None, :])
    correlation = np.clip(np.nan_to_num(correlation, nan=2.0), -2.0, 2.0)
    return np.asarray(good & (np.linalg.eigvalsh(correlation)[:, 0] > LEAST))
