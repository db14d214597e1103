# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far off were the states, beside the plots, and did their covariances say so?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Bools, Floats
from tracking_core.linalg import is_positive_definite
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import PlotRows, TrackRows, Truth

NAN = float('nan')


@dataclass(frozen=True)
class Accuracy:
    """Root mean square errors and normalised ones; NaN where there is nothing to judge."""

    rmse: float  # of the position [m]
    rmse_straight: float
    rmse_turning: float
    velocity_rmse: float = NAN  # [m/s]
    nees_position: float = NAN  # per dimension, 1 if the covariance is right
    nees_state: float = NAN
    offset: tuple[float, ...] = ()  # median of the error by axis [m]
    rows: int = 0
    velocity_straight: float = NAN
    velocity_turning: float = NAN


def track_error(rows: TrackRows, matches: Matches, has_velocity: bool = True) -> Accuracy:
    """Return how far the matched rows are from their contacts; each look counts once."""
    new = rows.is_new[matches.row]
    row, truth = matches.row[new], matches
    position = rows.position[row] - truth.position[new]
    velocity = rows.velocity[row] - truth.velocity[new]
    P, d = rows.covariance[row], position.shape[1]
    state = np.concatenate([position, velocity], axis=1)
    speed = _split(velocity, truth.turning[new]) if has_velocity else (NAN, NAN, NAN)
    return Accuracy(
        *_split(position, truth.turning[new]),
        velocity_rmse=speed[0],
        nees_position=_nees(position, P[:, :d, :d]),
        nees_state=_nees(state, P) if has_velocity else NAN,
        offset=_offset(position),
        rows=len(row),
        velocity_straight=speed[1],
        velocity_turning=speed[2],
    )


def plot_error(plots: PlotRows, truth: Truth) -> Accuracy:
    """Return how far the plots are from the contacts that made them."""
    errors, turning = [np.zeros((0, plots.position.shape[1]))], [np.zeros(0, bool)]
    for contact in np.unique(truth.id):
        mine = plots.contact == contact
        place = truth.of_contact(contact).at(plots.time[mine])
        errors.append(plots.position[mine] - place.position)
        turning.append(place.turning)
    error = np.concatenate(errors)
    return Accuracy(*_split(error, np.concatenate(turning)), offset=_offset(error),
                    rows=len(error))  # fmt: skip


def _split(error: Floats, turning: Bools) -> tuple[float, float, float]:
    return _rms(error), _rms(error[~turning]), _rms(error[turning])


def _rms(error: Floats) -> float:
    return float(np.sqrt((error**2).sum(axis=1).mean())) if len(error) else NAN


def _offset(error: Floats) -> tuple[float, ...]:
    return tuple(float(x) for x in np.median(error, axis=0)) if len(error) else ()


def _nees(error: Floats, P: Floats) -> float:
    """Return the mean normalised squared error per dimension."""
    squares = normalised(error, P)
    squares = squares[np.isfinite(squares)]
    return float(squares.mean() / error.shape[1]) if len(squares) else NAN


def normalised(error: Floats, P: Floats) -> Floats:
    """Return the squares (N,) of errors (N, n) by covariances (N, n, n); NaN where P is none."""
    squares, sound = np.full(len(error), NAN), is_positive_definite(P)
    error, P = error[sound], P[sound]
    squares[sound] = (error * np.linalg.solve(P, error[..., None])[..., 0]).sum(axis=1)
    return squares
