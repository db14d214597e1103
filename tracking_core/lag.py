# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How far behind is a filter with a given gain? As far as its innovations cannot be plot noise.

An innovation beyond its bound even in the mode of the largest gain is taken for an acceleration
since the last plot, of the size that explains it. What the gain leaves of it in position and
velocity goes into the covariance, so that the next gate is as wide as the lag. Gains say nothing
of range rates, so these are given what any lag within the gate may do to them.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.chances import chi_square_bound
from tracking_core.gains import benedict_bordner, on_axes
from tracking_core.linalg import over_modes, sum_by_track

_FALSE_ALARM = 0.01  # chance to take the noise of one plot for a lag


def lag_of_range_rates(
    mixture: Mixture, track: Ints, measurement: Measurement, interval: Floats
) -> Measurement:
    """
    Return the measurement with range rates as unsure as the velocity of a filter that may lag.

    An acceleration since the last plot, T ago, that moved the position by s has changed the
    velocity by 2 s / T. How large s may be is known: as the innovation in the widest mode.
    """
    n = mixture.mean.shape[2]
    if measurement.value.shape[1] == n // 2:
        return measurement
    sight, T = measurement.matrix[:, -1, 1::2], interval[track]
    P = mixture.covariance[track, :, 0::2, 0::2]
    ahead = over_modes(np.maximum, np.einsum('pa,pjab,pb->pj', sight, P, sight))
    ahead += np.einsum('pa,pab,pb->p', sight, measurement.covariance[:, :-1, :-1], sight)
    covariance = measurement.covariance.copy()
    covariance[:, -1, -1] += np.divide(4.0 * ahead, T**2, where=T > 0.0, out=np.zeros(len(T)))
    return replace(measurement, covariance=covariance)


def excess_of_innovations(
    innovations: Innovations, mode: int, track: Ints, association: Association, axes: int
) -> Floats:
    """
    Return nu nu^T of each track (T, a, a) as far as it is beyond what S explains.

    The excess E is such that nu is as far as it should be on average in S + E, where it is beyond
    its bound in S; below that it is 0.
    """
    nu, distance = innovations.innovation[:, mode, :axes], innovations.distance[:, mode]
    beyond = 1.0 / axes - 1.0 / np.maximum(distance, axes)
    weight = np.where(distance > _bound(axes), beyond, 0.0) * association.probability
    square = weight[:, None, None] * nu[:, :, None] * nu[:, None, :]
    return sum_by_track(square, track, len(association.miss))


def lag_covariance(excess: Floats, alpha: Floats, interval: Floats) -> Floats:
    """
    Return what is left of an acceleration after the update (T, n, n).

    Parameters
    ----------
    excess : (T, a, a) array
        Covariance of what the acceleration did to the position [m^2].
    alpha : (T,) array
        Gain that was used: 1 - alpha of the position is left, (2 - beta) / T of the velocity.
    interval : (T,) array
        T, time since the last plot [s].

    """
    left = np.stack([1.0 - alpha, 2.0 - benedict_bordner(alpha)], axis=1)
    shape = left[:, None, :, None] * left[:, None, None, :]
    return on_axes(excess, shape, interval)[:, 0]


@lru_cache(maxsize=8)
def _bound(axes: int) -> float:
    """Return what the squared innovation stays below without a lag."""
    return chi_square_bound(1.0 - _FALSE_ALARM, axes)
