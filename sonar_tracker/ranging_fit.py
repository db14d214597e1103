# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which straight course explains the bearings best? Maximum likelihood, many tracks at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sonar_tracker.ranging_model import compare, in_axes, Legs, residuals
from tracking_core.batches import Bools, Floats
from tracking_core.linalg import symmetrise, wrap_angle
from tracking_core.rows import change, take

_STARTS = 12  # ranges that are tried, evenly in their logarithm
_STEPS = 25  # of Levenberg and Marquardt; half a dozen are usual
_MOST_STEPS = 400  # of those few that creep along a valley, as with marks near an array's axis
_DONE = 1e-4  # a step that lowers chi-square of a good fit by less than this is the last
_FIRST_DAMPING = 1e-3
_STUCK = 1e9  # damping at which no step is left
_RIDGE = 1e-9  # of the linear start, as a part of all that is known
_FLOOR = 1e-12  # of the damping, in units of the best known parameter: no singular matrices


@dataclass(frozen=True)
class Fit:
    """The best straight course of T tracks: b, c span, w span, u reach."""

    state: Floats  # (T, 4)
    slope: Floats  # (T, K, 4) of the bearings by the state, in sd of the marks, whitened
    residual: Floats  # (T, K) bearings less those of the course, in sd of the marks, whitened
    information: Floats  # (T, 4, 4) of the state, Fisher
    chi_square: Floats  # (T,)
    serial: Floats  # (T,) sum of products of neighbouring residuals over its sd
    arrived: Bools  # (T,) no step lowers chi-square any more


def fit(legs: Legs, range_min: float, range_max: float) -> Fit:
    """
    Return the maximum-likelihood straight course of each track.

    Parameters
    ----------
    legs : Legs
        Marks; `reach` must not be 0.
    range_min, range_max : float
        Where contacts may be [m].

    References
    ----------
    [NARDONE84] for the estimate, [AIDALA83] for the coordinates.

    """
    low, high = legs.reach / range_max, legs.reach / range_min
    state, going = _descend(_start(legs, low, high), legs, low, high, _STEPS)
    slow = np.flatnonzero(going)
    if len(slow):
        rest = take(legs, slow)
        state[slow], going[slow] = _descend(state[slow], rest, low[slow], high[slow], _MOST_STEPS)
    residual, slope = compare(state, legs)
    count = (legs.weight > 0.0).sum(axis=1)
    serial = (residual[:, 1:] * residual[:, :-1]).sum(axis=1) / np.sqrt(count)
    information = symmetrise(np.swapaxes(slope, 1, 2) @ slope)
    chi_square = (residual**2).sum(axis=1)
    return Fit(state, slope, residual, information, chi_square, serial, ~going)


def _descend(
    state: Floats, legs: Legs, low: Floats, high: Floats, steps: int
) -> tuple[Floats, Bools]:
    """Return the states (T, 4) after so many steps at most, and which have not arrived (T,)."""
    residual, slope = compare(state, legs)
    chi_square, count = (residual**2).sum(axis=1), (legs.weight > 0.0).sum(axis=1)
    damping, going = np.full(len(state), _FIRST_DAMPING), np.ones(len(state), bool)
    for _ in range(steps):
        u, downhill = state[:, 3], np.einsum('tk,tk->t', slope[..., 3], residual)
        stopped = ((u <= low) & (downhill < 0.0)) | ((u >= high) & (downhill > 0.0))
        trial = state + _step(residual, slope, damping, stopped)
        trial[:, 3] = np.clip(trial[:, 3], low, high)
        new_residual, new_slope = compare(trial, legs)
        new_chi_square = (new_residual**2).sum(axis=1)
        better = going & (new_chi_square <= chi_square)
        done = _DONE * np.maximum(chi_square / count, 1.0)
        going &= ~better | (chi_square - new_chi_square > done)
        state = np.where(better[:, None], trial, state)
        residual = np.where(better[:, None], new_residual, residual)
        slope = np.where(better[:, None, None], new_slope, slope)
        chi_square = np.where(better, new_chi_square, chi_square)
        damping = np.minimum(damping * np.where(better, 0.1, 10.0), _STUCK)
        going &= damping < _STUCK
        if not going.any():
            break
    return state, going


def _step(residual: Floats, slope: Floats, damping: Floats, stopped: Bools) -> Floats:
    """Return the damped step of Gauss and Newton (T, 4), where u is stopped that of the others."""
    slope = slope * np.where(stopped[:, None, None], [1.0, 1.0, 1.0, 0.0], 1.0)
    normal = np.swapaxes(slope, 1, 2) @ slope
    gradient = np.einsum('tka,tk->ta', slope, residual)
    diagonal = np.einsum('taa->ta', normal)
    damped = normal.copy()
    floor = _FLOOR * diagonal.max(axis=1, keepdims=True)
    damped[:, range(4), range(4)] += damping[:, None] * diagonal + floor
    return np.asarray(np.linalg.solve(damped, gradient[..., None])[..., 0])


def _start(legs: Legs, low: Floats, high: Floats) -> Floats:
    """
    Return the best of several ranges (T, 4), each with the course that fits it.

    For a given u the equation sin(z) along = cos(z) across, z the bearing about the newest, is
    linear in c, w and a small change of b.
    """
    rows = np.arange(len(low))
    newest = np.argmax(np.where(legs.weight > 0.0, legs.tau, -np.inf), axis=1)
    b = legs.bearing[rows, newest]
    z = wrap_angle(legs.bearing - b[:, None])
    cos, sin = np.cos(z), np.sin(z)
    d_along, d_across = in_axes(legs.aside, b[:, None])
    basis = np.stack([-cos, sin * legs.tau, -cos * legs.tau], axis=-1)  # of b, c, w
    by_u = cos * d_across - sin * d_along
    weighted = basis * legs.weight[..., None]
    normal = np.swapaxes(weighted, 1, 2) @ basis
    normal[:, range(3), range(3)] += _RIDGE * np.einsum('taa->t', normal)[:, None]
    right = np.swapaxes(weighted, 1, 2) @ np.stack([-sin, -by_u], axis=-1)
    solved = np.linalg.solve(normal, right)  # (T, 3, 2): without u, and by u
    u = low * (high / low) ** (np.arange(_STARTS) / (_STARTS - 1.0))[:, None]  # (starts, T)
    state = np.empty((_STARTS, len(low), 4))
    state[..., 0], state[..., 1:3], state[..., 3] = b, 0.0, u
    state[..., :3] += solved[..., 0] + u[..., None] * solved[..., 1]
    tried = take(change(legs, whitening=None), np.tile(rows, _STARTS))
    chi_square = (residuals(state.reshape(-1, 4), tried) ** 2).sum(axis=1).reshape(u.shape)
    return np.asarray(state[np.argmin(chi_square, axis=0), rows])
