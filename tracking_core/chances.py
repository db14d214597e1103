# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What many files ask of probabilities."""

from __future__ import annotations

import numpy as np
from scipy.special import gammaincinv

from tracking_core.batches import Floats

TINY = 1e-300  # least divisor, and least chance that a logarithm is taken of
MORE_LIKELY_THAN_NOT = 0.5


def chi_square_bound(probability: float, degrees: int) -> float:
    """Return what a chi-square variable of so many degrees stays below with this probability."""
    return float(2.0 * gammaincinv(0.5 * degrees, probability))


def log(probability: Floats) -> Floats:
    """Return the logarithm, that of `TINY` for 0."""
    return np.asarray(np.log(np.maximum(probability, TINY)))
