# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a heading do that is wrong for a while? It moves neighbouring marks alike.

Its error is that of all marks, and is forgotten exponentially, as that of Ornstein and Uhlenbeck.
"""

from __future__ import annotations

import numpy as np

from sonar_tracker.ranging_model import Legs
from tracking_core.batches import Floats
from tracking_core.rows import change

_MEMORY = 30.0  # s, over which an error of the heading is forgotten


def with_wandering(legs: Legs, heading_sd: float) -> Legs:
    """
    Return the legs with marks that share a heading whose error has this sd [rad].

    Residuals are whitened by the inverse of the root of their covariance, in sd of the marks
    1 + heading_sd^2 kept / (sd sd'), as in generalised least squares.
    """
    age = -legs.tau * legs.span[:, None]
    kept = np.exp(-np.abs(age[:, :, None] - age[:, None]) / _MEMORY)
    shared = heading_sd * np.sqrt(legs.weight)  # rows without a mark share nothing
    covariance = np.eye(age.shape[1]) + shared[:, :, None] * shared[:, None] * kept
    return change(legs, whitening=np.linalg.inv(np.linalg.cholesky(covariance)))


def misheaded(legs: Legs, gain: Floats) -> Floats:
    """
    Return what a heading with an sd of 1 rad adds to the variance (T,) of a sum over marks.

    What older marks do to each is summed in strides that double: so there is no matrix of marks
    by marks.

    Parameters
    ----------
    legs : Legs
        The marks.
    gain : (T, K) array
        By which the sum follows them.

    """
    step = np.diff(legs.tau, axis=1, prepend=legs.tau[:, :1]) * legs.span[:, None]
    kept = np.exp(-np.maximum(step, 0.0) / _MEMORY)  # rows without a mark: tau 0, no gain
    total, stride = gain.copy(), 1
    while stride < gain.shape[1]:
        total[:, stride:] += kept[:, stride:] * total[:, :-stride]
        kept[:, stride:] *= kept[:, :-stride]
        stride *= 2
    return np.asarray((gain * (2.0 * total - gain)).sum(axis=1))
