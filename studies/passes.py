# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does an estimator follow one contact through many runs? All runs are one batch of tracks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from tqdm import tqdm

from radar_tracker.conversion import to_cartesian, to_polar
from tracking_core.batches import Association, Floats, Measurement, Mixture
from tracking_core.composition import Plane
from tracking_core.linalg import symmetrise


@dataclass(frozen=True)
class Measured:
    """Plots of one contact: K contacts (looks), T runs."""

    position: Floats  # (K, T, d) [m]
    covariance: Floats  # (K, T, d, d) [m^2]


@dataclass(frozen=True)
class Step:
    """What one plane of all runs was before and after one contact."""

    predicted: Mixture
    updated: Mixture


def measure(truth: Floats, sd: Floats, noise: Floats) -> Measured:
    """
    Return polar measurements of true positions, converted to Cartesian ones.

    Parameters
    ----------
    truth : (K, d) array
        [m]
    sd : (d,) array
        Of range [m], azimuth and elevation [rad].
    noise : (T, K, d) array
        Standard normal, in the same order.

    """
    T, K, d = noise.shape
    polar = to_polar(truth) + noise * sd
    rows = np.swapaxes(polar, 0, 1).reshape(-1, d)
    position, covariance = to_cartesian(rows, np.broadcast_to(sd, rows.shape))
    return Measured(position.reshape(K, T, d), covariance.reshape(K, T, d, d))


def two_point_start(planes: Sequence[Plane], measured: Measured, dt: float) -> list[Mixture]:
    """Return each plane after contacts 0 and 1: P = [R1, R1/T; R1/T, (R0 + R1)/T^2]."""
    starts = []
    for plane in planes:
        at = np.array(plane.coordinates)
        z0, z1 = measured.position[:2, :, at]
        R0, R1 = measured.covariance[:2, :, at[:, None], at]
        T, d = z1.shape
        mean, covariance = np.empty((T, 2 * d)), np.empty((T, 2 * d, 2 * d))
        mean[:, 0::2], mean[:, 1::2] = z1, (z1 - z0) / dt
        covariance[:, 0::2, 0::2], covariance[:, 1::2, 1::2] = R1, (R0 + R1) / dt**2
        covariance[:, 0::2, 1::2] = covariance[:, 1::2, 0::2] = R1 / dt
        starts.append(plane.estimator.start(mean, symmetrise(covariance)))
    return starts


def run(
    planes: Sequence[Plane],
    measured: Measured,
    dt: float,
    quiet: bool = True,
    start: Sequence[Mixture] | None = None,
) -> list[list[Step]]:
    """
    Return the steps of every plane for the contacts 2, 3, ..., association being certain.

    With a start given for contact 0 they are those of the contacts 1, 2, ...

    Parameters
    ----------
    planes : sequence of Plane
        Estimators with their coordinates.
    measured : Measured
        K contacts of T runs.
    dt : float
        Between two contacts [s].
    quiet : bool
        Show no progress bar.
    start : sequence of Mixture, optional
        Each plane after contact 0; without it tracks start from contacts 0 and 1.

    """
    K, T, _ = measured.position.shape
    now = two_point_start(planes, measured, dt) if start is None else list(start)
    first = 2 if start is None else 1
    track, nothing = np.arange(T), np.zeros(T)
    certain = Association(np.ones(T), nothing, np.zeros(T, bool))
    steps: list[list[Step]] = [[] for _ in planes]
    for k in tqdm(range(first, K), desc='contacts', disable=quiet, leave=False):
        for p, plane in enumerate(planes):
            at = np.array(plane.coordinates)
            H = np.broadcast_to(_position_of(len(at)), (T, len(at), 2 * len(at)))
            z = Measurement(
                measured.position[k][:, at],
                H,
                measured.covariance[k][:, at[:, None], at],
                np.zeros(T, np.int64),
            )
            predicted = plane.estimator.predict(now[p], np.full(T, dt))
            innovations = plane.estimator.innovate(predicted, track, z)
            now[p] = plane.estimator.update(predicted, track, innovations, certain)
            steps[p].append(Step(predicted, now[p]))
    return steps


def _position_of(axes: int) -> Floats:
    matrix = np.zeros((axes, 2 * axes))
    matrix[np.arange(axes), 2 * np.arange(axes)] = 1.0
    return matrix
