# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which bearings does a straight course make, seen from a moving sensor?

The unknowns are modified polar, at the time of the newest mark: bearing b, range rate over range
c, bearing rate w, and 1 / range u. With tau the time from then and d(tau) how far the sensor is
from an even motion, in axes along and across b,

    bearing(tau) = b + atan2(w tau - u d_across, 1 + c tau - u d_along).

Without a manoeuvre of the own ship d is 0 and u is not in the equation: nothing is known of the
range, and the rest is still found.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sonar_tracker.bearing_history import PastMarks
from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle


@dataclass(frozen=True)
class Legs:
    """Bearing marks about their newest, in units in which all numbers are about 1."""

    tau: Floats  # (T, K) time after the newest mark [span]
    bearing: Floats  # (T, K) [rad]
    weight: Floats  # (T, K) 1 / variance [1/rad^2]
    aside: Floats  # (T, K, 2) sensor from an even motion [reach]
    time: Floats  # (T,) of the newest mark [s]
    own: Floats  # (T, 2) sensor at that time [m]
    velocity: Floats  # (T, 2) of the even motion [m/s]
    span: Floats  # (T,) [s]
    reach: Floats  # (T,) greatest |d| [m]
    whitening: Floats | None = None  # (T, K, K) of the residuals of marks that err alike


def legs_of(points: PastMarks) -> Legs:
    """Return the marks about their newest; every track must have at least two."""
    rows = np.arange(len(points.time))
    has = points.weight > 0.0
    last = has.shape[1] - 1 - np.argmax(has[:, ::-1], axis=1)
    time, own = points.time[rows, last], points.own[rows, last]
    tau = np.where(has, points.time - time[:, None], 0.0)
    moved = np.where(has[..., None], points.own - own[:, None], 0.0)
    # The even motion from which the sensor was the least away.
    square = np.einsum('tk,tk->t', points.weight, tau**2)
    velocity = np.einsum('tk,tkx->tx', points.weight * tau, moved) / square[:, None]
    aside = moved - velocity[:, None] * tau[..., None]
    span, reach = -tau.min(axis=1), np.sqrt((aside**2).sum(axis=2).max(axis=1))
    return Legs(
        tau / span[:, None], points.bearing, points.weight,
        aside / np.where(reach > 0.0, reach, 1.0)[:, None, None], time, own, velocity, span, reach,
    )  # fmt: skip


def courses(state: Floats, legs: Legs) -> tuple[Floats, Floats]:
    """
    Return x, y, vx, vy (T, 4) at the time of the newest mark and their Jacobian (T, 4, 4).

    In the tracking frame [m, m/s].
    """
    b, (c, w) = state[:, 0], state[:, 1:3].T / legs.span
    u = state[:, 3] / legs.reach
    along = np.stack([np.cos(b), np.sin(b)], axis=1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    drift = c[:, None] * along + w[:, None] * across  # relative velocity over range
    turned = c[:, None] * across - w[:, None] * along
    distance = (1.0 / u)[:, None]
    position, velocity = legs.own + along * distance, legs.velocity + drift * distance
    nothing, per_span = np.zeros_like(along), distance / legs.span[:, None]
    per_u = -(distance**2) / legs.reach[:, None]
    columns = (
        (across * distance, turned * distance),
        (nothing, along * per_span),
        (nothing, across * per_span),
        (along * per_u, drift * per_u),
    )
    jacobian = np.stack([np.concatenate(column, axis=1) for column in columns], axis=-1)
    return np.concatenate([position, velocity], axis=1), jacobian


def distances(state: Floats, legs: Legs) -> tuple[Floats, Floats]:
    """Return distance [m] and bearing [rad] (T, K) at the time of each mark."""
    along, across = _lines(state, legs)[:2]
    distance = np.hypot(along, across) * (legs.reach / state[:, 3])[:, None]
    return distance, state[:, :1] + np.arctan2(across, along)


def residuals(state: Floats, legs: Legs) -> Floats:
    """Return bearings less those of the model (T, K) in sd of the marks."""
    along, across = _lines(state, legs)[:2]
    return _residuals(state, legs, along, across)


def compare(state: Floats, legs: Legs) -> tuple[Floats, Floats]:
    """Return residuals (T, K) in sd and the slope of the model in sd (T, K, 4), whitened."""
    along, across, d_along, d_across = _lines(state, legs)
    u, root = state[:, 3:], np.sqrt(legs.weight)
    residual = _residuals(state, legs, along, across)
    scale = root / (along**2 + across**2)
    slope = np.empty((*legs.tau.shape, 4))
    slope[..., 0] = root + scale * u * (along * d_along + across * d_across)
    slope[..., 1] = -scale * across * legs.tau
    slope[..., 2] = scale * along * legs.tau
    slope[..., 3] = scale * (across * d_along - along * d_across)
    if legs.whitening is None:
        return residual, slope
    return (legs.whitening @ residual[..., None])[..., 0], legs.whitening @ slope


def _residuals(state: Floats, legs: Legs, along: Floats, across: Floats) -> Floats:
    off = wrap_angle(legs.bearing - state[:, :1] - np.arctan2(across, along))
    return np.asarray(np.sqrt(legs.weight) * off)


def _lines(state: Floats, legs: Legs) -> tuple[Floats, Floats, Floats, Floats]:
    """Return contact from sensor over range, along and across b, and d the same way (T, K)."""
    b, c, w, u = state.T[:, :, None]
    d_along, d_across = in_axes(legs.aside, b)
    return 1.0 + c * legs.tau - u * d_along, w * legs.tau - u * d_across, d_along, d_across


def in_axes(aside: Floats, bearing: Floats) -> tuple[Floats, Floats]:
    """Return (T, K, 2) along and across the bearings (T, 1)."""
    cos, sin = np.cos(bearing), np.sin(bearing)
    x, y = aside[..., 0], aside[..., 1]
    return cos * x + sin * y, cos * y - sin * x
