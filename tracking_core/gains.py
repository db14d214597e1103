# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What follows from a gain alpha: beta, and the covariance of a filter that has settled?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints


def benedict_bordner(alpha: Floats) -> Floats:
    """Return beta = alpha^2 / (2 - alpha) [BENEDICT62]."""
    return np.asarray(alpha * alpha / (2.0 - alpha))


def gain_matrix(alpha: Floats, interval: Floats, track: Ints, cross: Floats) -> Floats:
    """
    Return alpha and beta / T on the axes that a plot has, 0 elsewhere.

    Parameters
    ----------
    alpha : (T, J) array
        Of the modes.
    interval : (T,) array
        Time since the last plot [s]; where it is 0 the velocity is not corrected.
    track : (P,) array
        Row of each pair's track.
    cross : (P, J, n, d) array
        P H^T; its columns beyond the n / 2 axes have no gain.

    Returns
    -------
    (P, J, n, d) array

    """
    axes = cross.shape[2] // 2
    gain, axis = np.zeros_like(cross), np.arange(axes)
    has = (cross != 0.0).any(axis=2)[:, :, :axes]  # (P, J, a)
    per_second = np.divide(1.0, interval, where=interval > 0.0, out=np.zeros(len(interval)))
    rate = benedict_bordner(alpha) * per_second[:, None]
    gain[:, :, 2 * axis, axis] = alpha[track][..., None] * has
    gain[:, :, 2 * axis + 1, axis] = rate[track][..., None] * has
    return gain


def steady_noise(alpha: float) -> Floats:
    """
    Return the process noise (2, 2) for which (alpha, beta) is the Kalman gain, R = 1, T = 1.

    Velocity noise and its covariance with position are those of white acceleration; position
    noise is what is left to make S = 1 / (1 - alpha).
    """
    before, after = steady_covariance(alpha)
    F = np.array([[1.0, 1.0], [0.0, 1.0]])
    return np.asarray(before - F @ after @ F.T)


def steady_covariance(alpha: float) -> tuple[Floats, Floats]:
    """Return predicted and updated covariance (2, 2) of a settled filter, R = 1, T = 1."""
    beta, rest = alpha * alpha / (2.0 - alpha), 1.0 - alpha
    velocity = 0.5 * beta * (2.0 * alpha - beta) / rest
    before = np.array([[alpha, beta], [beta, velocity * rest + beta * beta]]) / rest
    return before, np.array([[alpha, beta], [beta, velocity]])


def noise_gain(alpha: Floats) -> Floats:
    """
    Return the variance of a settled filter's predicted position per variance of the plots.

    References
    ----------
    [KHACH02] (2 a^2 + a b + 2 b) / (a (4 - 2 a - b)); the innovation has one more.

    """
    beta = alpha * alpha / (2.0 - alpha)
    top = 2.0 * alpha * alpha + alpha * beta + 2.0 * beta
    return np.asarray(top / (alpha * (4.0 - 2.0 * alpha - beta)))


def on_axes(noise: Floats, shape: Floats, interval: Floats) -> Floats:
    """
    Return a covariance of plots times a shape of position and velocity.

    Parameters
    ----------
    noise : (T, a, a) array
        Of the axes [m^2].
    shape : (J, 2, 2) or (T, J, 2, 2) array
        Of position and velocity, for an interval of 1.
    interval : (T,) array
        [s]; where it is 0 so is the answer.

    Returns
    -------
    (T, J, n, n) array

    """
    T, a, _ = noise.shape
    shape = np.broadcast_to(shape, (T, *shape.shape[-3:]))
    per_second = np.divide(1.0, interval, where=interval > 0.0, out=np.zeros(T))
    unit = np.stack([(interval > 0.0).astype(np.float64), per_second], axis=1)
    full = np.einsum('tab,tjkl,tk,tl->tjakbl', noise, shape, unit, unit)
    return np.asarray(full.reshape(T, shape.shape[1], 2 * a, 2 * a))
