# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do the covariances tell the truth? Normalised squares and the band they ought to be in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_core.chances import chi_square_bound
from tracking_tools.scoring.accuracy import NAN

BAND = (0.025, 0.975)  # 95 % between them


@dataclass(frozen=True)
class Consistency:
    """Mean of normalised squares per dimension: 1 if the covariances are right."""

    mean: float = NAN
    low: float = NAN  # band of the mean of so many independent samples
    high: float = NAN
    inside: float = NAN  # share of the samples below the 95 % quantile of one sample
    samples: int = 0
    dimensions: int = 0

    @property
    def is_inside(self) -> bool:
        """Whether the mean is in the band."""
        return bool(self.low <= self.mean <= self.high)


def consistency(squares: Floats, dimensions: int) -> Consistency:
    """
    Judge normalised squared errors (NEES) or innovations (NIS).

    Parameters
    ----------
    squares : (N,) array
        Chi-square with `dimensions` degrees if all is right; what is not finite is left out.
    dimensions : int
        Of the error.

    References
    ----------
    Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001,
    section 5.4.

    """
    squares = squares[np.isfinite(squares)]
    N, n = len(squares), dimensions
    if N == 0:
        return Consistency(dimensions=n)
    low, high = (chi_square_bound(p, N * n) / (N * n) for p in BAND)
    inside = float((squares <= chi_square_bound(0.95, n)).mean())
    return Consistency(float(squares.mean() / n), low, high, inside, N, n)
