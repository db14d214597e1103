# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How wrong may a straight course be of a contact whose velocity drifts as far as its marks allow?

A drift that the fit follows is in no residual; one that it does not follow is. So the residuals
say how likely each strength of the drift is, and each strength how far the fit may have followed.
"""

from __future__ import annotations

import numpy as np

from sonar_tracker.ranging_fit import Fit
from sonar_tracker.ranging_model import distances, Legs
from tracking_core.batches import Floats
from tracking_core.linalg import symmetrise

_DRIFTS = np.array([0.01, 0.03, 0.1, 0.3, 1.0])  # that are tried [m/s/sqrt(s)]
_NONE = 0.003  # m/s/sqrt(s), a drift that is taken for none
_CHANGES = 8  # of the velocity, evenly in time, in place of a drift


def strayed(bound: Floats, best: Fit, legs: Legs, noise: Floats, usual: float) -> Floats:
    """
    Return the covariance (T, 4, 4) about the straight courses of contacts that may have strayed.

    The mixture over no drift and those of `_DRIFTS`, each the less likely the farther it is from
    the usual one, and by the restricted likelihood of the residuals: the course integrated out.

    Parameters
    ----------
    bound : (T, 4, 4) array
        Covariance of the states of contacts that go straight.
    best, legs
        The fits, to which marks.
    noise : (T,) array
        Variance of the marks in units of the one that they tell.
    usual : float
        Drift that is the likeliest before there are marks; 0: surely none [m/s/sqrt(s)].

    """
    if usual == 0.0:
        return bound
    moved = _moved(best, legs)
    by_mark = np.swapaxes(moved, 1, 2) / noise[:, None, None]
    common = by_mark @ best.slope
    followed = bound @ np.swapaxes(common, 1, 2)  # (T, 4, C) by the fit
    size, axes = np.linalg.eigh(symmetrise(by_mark @ moved - common @ followed))
    size, followed = np.maximum(size, 0.0), followed @ axes
    seen = (np.swapaxes(axes, 1, 2) @ (by_mark @ best.residual[..., None]))[..., 0]  # (T, C)

    prior = _DRIFTS[:, None, None] ** 2
    variance = prior / (1.0 + prior * size)  # (V, T, C) of the changes, given the residuals
    evidence = 0.5 * (variance * seen**2 - np.log1p(prior * size)).sum(axis=2)
    odds = _log_odds(usual)[:, None] + evidence
    chance = np.exp(odds - np.logaddexp.reduce(odds, axis=0, initial=0.0))  # (V, T)
    off = followed @ np.moveaxis(variance * seen, 0, 2)  # (T, 4, V)
    spread = (chance[..., None] * variance).sum(axis=0)
    wider = (followed * spread[:, None]) @ np.swapaxes(followed, 1, 2)
    return np.asarray(bound + wider + (off * chance.T[:, None]) @ np.swapaxes(off, 1, 2))


def _log_odds(usual: float) -> Floats:
    """Return those of each drift against none: it is off the usual by so many times."""
    off = np.abs(np.log(np.append(_NONE, _DRIFTS) / usual))
    return np.asarray(off[0] - off[1:])


def _moved(best: Fit, legs: Legs) -> Floats:
    """Return by how many sds changes of the velocity move the marks before them (T, K, C)."""
    distance, direction = distances(best.state, legs)
    age = (-legs.tau * legs.span[:, None])[..., None]
    step = (legs.span / _CHANGES)[:, None, None]
    way = np.maximum(age - step * (np.arange(_CHANGES) + 0.5), 0.0) * np.sqrt(step)
    scale = (np.sqrt(legs.weight) / distance)[..., None] * way
    along_x, along_y = np.sin(direction)[..., None], -np.cos(direction)[..., None]
    moved = np.concatenate([scale * along_x, scale * along_y], axis=2)
    return moved if legs.whitening is None else legs.whitening @ moved
