# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do range, azimuth and elevation say in Cartesian coordinates, and how surely?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Plots

BIAS_LIMIT = 0.4  # of r s^2 / s_r, beyond which the bent noise of far plots is straightened out


def to_cartesian(polar: Floats, sd: Floats) -> tuple[Floats, Floats]:
    """
    Convert polar or spherical plots with their covariance.

    Parameters
    ----------
    polar : (M, 2) or (M, 3) array
        Range [m], azimuth and, if three, elevation [rad].
    sd : (M, 2) or (M, 3) array
        Standard deviations of the same.

    Returns
    -------
    position : (M, d) array
        [m]
    covariance : (M, d, d) array
        Linearised at the plot, J diag(sd^2) J^T; for plots with r s^2 / s_r > 0.4 both are those
        of the unbiased conversion, and where J is singular the covariance is `blurred`.

    References
    ----------
    [ZHUK09] eq. 10 to 15, with the misprints in (13) to (15) put right; [MUCM] for the rest.

    """
    position, covariance = linearised(polar, sd)
    angle_sd = sd[:, 1:].max(axis=1, initial=0.0)
    bent = polar[:, 0] * angle_sd**2 > BIAS_LIMIT * sd[:, 0]
    if bent.any():
        position[bent], covariance[bent] = unbiased(polar[bent], sd[bent])
    near = (polar[:, 0] < sd[:, 0]) | (np.cos(_columns(polar)[2]) < _elevation_sd(sd))
    if near.any():
        covariance[near] = blurred(polar[near], sd[near])
    return position, covariance


def blurred(polar: Floats, sd: Floats) -> Floats:
    """
    Return the covariance (M, d, d) of plots beside the origin or the zenith, where J is singular.

    Plots nearer than their range noise are as unsure across as those at that range; within one
    sd of the zenith, where azimuth tells nothing, they are as unsure across as in elevation.
    """
    r, azimuth, elevation = _columns(polar)
    cb, sb, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    arm, tilt, d = np.maximum(r, sd[:, 0]), _elevation_sd(sd), polar.shape[1]
    across = np.where(ce < tilt, tilt, ce * sd[:, 1])
    along = np.stack([ce * cb, ce * sb, se], axis=1)
    left = np.stack([-sb, cb, np.zeros_like(r)], axis=1)
    up = np.stack([-se * cb, -se * sb, ce], axis=1)
    axes = np.stack([along, left, up], axis=2)[:, :d, :d]
    scaled = axes * np.stack([sd[:, 0], arm * across, arm * tilt], axis=1)[:, None, :d]
    return np.asarray(scaled @ np.swapaxes(scaled, 1, 2))


def linearised(polar: Floats, sd: Floats) -> tuple[Floats, Floats]:
    """Return position (M, d) and J diag(sd^2) J^T (M, d, d) of plots as in `to_cartesian`."""
    r, azimuth, elevation = _columns(polar)
    cb, sb, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    J = np.empty((len(r), 3, 3), order='F')
    J[:, 0, 0], J[:, 1, 0], J[:, 2, 0] = ce * cb, ce * sb, se  # d position / d range
    J[:, 0, 1], J[:, 1, 1], J[:, 2, 1] = -r * ce * sb, r * ce * cb, 0.0  # d azimuth
    J[:, 0, 2], J[:, 1, 2], J[:, 2, 2] = -r * se * cb, -r * se * sb, r * ce  # d elevation
    d = polar.shape[1]
    scaled = J[:, :d, :d] * sd[:, None, :]
    return r[:, None] * J[:, :d, 0], np.einsum('mik,mjk->mij', scaled, scaled, order='F')


def unbiased(polar: Floats, sd: Floats) -> tuple[Floats, Floats]:
    """
    Return position (M, d) and covariance (M, d, d), the mean shift of large angle noise taken out.

    Plots as in `to_cartesian`.

    References
    ----------
    [MUCM] multiplicative unbiased conversion, covariance given the plot.

    """
    r, azimuth, elevation = _columns(polar)
    variance = np.zeros((len(r), 3))
    variance[:, : sd.shape[1]] = sd**2
    lb, le = np.exp(-0.5 * variance[:, 1]), np.exp(-0.5 * variance[:, 2])
    lb2, le2 = lb**4, le**4  # exp(-2 s^2)
    cb, sb, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    position = np.stack([r * ce * cb / lb / le, r * ce * sb / lb / le, r * se / le], axis=1)
    square, power = r**2, r**2 + variance[:, 0]
    ce2 = 1.0 + le2 * np.cos(2.0 * elevation)  # twice the mean of cos^2
    plane = (1.0 / (lb * le) ** 2 - 2.0) * square * ce**2
    tilt = (1.0 / (lb * le**2) - 1.0 / lb - lb) * square * se * ce
    tilt = tilt + 0.5 * power * lb * le2 * np.sin(2.0 * elevation)
    R = np.empty((len(r), 3, 3))
    R[:, 0, 0] = plane * cb**2 + 0.25 * power * (1.0 + lb2 * np.cos(2.0 * azimuth)) * ce2
    R[:, 1, 1] = plane * sb**2 + 0.25 * power * (1.0 - lb2 * np.cos(2.0 * azimuth)) * ce2
    R[:, 2, 2] = (1.0 / le**2 - 2.0) * square * se**2
    R[:, 2, 2] += 0.5 * power * (1.0 - le2 * np.cos(2.0 * elevation))
    R[:, 0, 1] = plane * sb * cb + 0.25 * power * lb2 * np.sin(2.0 * azimuth) * ce2
    R[:, 0, 2], R[:, 1, 2] = tilt * cb, tilt * sb
    R[:, 1, 0], R[:, 2, 0], R[:, 2, 1] = R[:, 0, 1], R[:, 0, 2], R[:, 1, 2]
    d = polar.shape[1]
    return position[:, :d], R[:, :d, :d]


def to_polar(position: Floats) -> Floats:
    """Return range [m], azimuth and, for three coordinates, elevation [rad] of (M, d)."""
    ground = np.hypot(position[:, 0], position[:, 1])
    azimuth = np.arctan2(position[:, 1], position[:, 0])
    if position.shape[1] == 2:
        return np.stack([ground, azimuth], axis=1)
    distance = np.hypot(ground, position[:, 2])
    return np.stack([distance, azimuth, np.arctan2(position[:, 2], ground)], axis=1)


def _elevation_sd(sd: Floats) -> Floats:
    return sd[:, 2] if sd.shape[1] == 3 else np.zeros(len(sd))


def _columns(polar: Floats) -> tuple[Floats, Floats, Floats]:
    elevation = polar[:, 2] if polar.shape[1] == 3 else np.zeros(len(polar))
    return polar[:, 0], polar[:, 1], elevation


def azimuth_of(plots: Plots, is_polar: bool) -> Floats:
    """Return the azimuths (M,) [rad]."""
    x, y, _ = plots.position.T
    return plots.azimuth if is_polar else np.asarray(np.arctan2(y, x))


def farthest(plots: Plots, is_polar: bool, dimensions: int) -> float:
    """Return how far the farthest of the plots (M > 0,) is from the sensor [m]."""
    if is_polar:
        return float(plots.range.max())
    x, y, z = plots.position.T
    ground = np.hypot(x, y)
    slant = np.hypot(ground, z) if dimensions == 3 else ground
    return float(np.fmax(ground, slant).max())  # z may be NaN
