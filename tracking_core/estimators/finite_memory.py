# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A straight line through the last plots, weighted: the filter that remembers nothing else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.chances import MORE_LIKELY_THAN_NOT, TINY
from tracking_core.kalman import innovate
from tracking_core.marks import as_data, average

_LEAST_POINTS = 3  # are never forgotten: a track that is not seen keeps its line


@dataclass(frozen=True)
class FiniteMemory:
    """
    Maximum-likelihood line through the plots of the last look and the `looks` before it.

    `Mixture.memory` holds of these, newest first: ages [s], bearings [rad], weights [1/rad^2].
    The bearing of a look is the mean of its plots by association probability, its weight
    (1 - miss) over the variance of that mean as a measurement: estimates are never used as data.

    References
    ----------
    [VORONINA19] eq. 10 to 14, with f in the place of the g that is in print.

    """

    looks: int  # K'

    axes: int = 1

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks: two points that have these means and covariances (T, 2, 2)."""
        T = len(mean)
        P, cross, V = covariance[:, 0, 0], covariance[:, 0, 1], covariance[:, 1, 1]
        # Of points b1 and b0 with variances R1, R0 and dt between: P = R1, cross = R1 / dt,
        # V = (R1 + R0) / dt^2. Where there is no such pair, R0 = R1 and dt gives the right V.
        is_pair = (cross > 0.0) & (cross**2 < V * P)
        dt = np.where(is_pair, P / np.where(is_pair, cross, 1.0), np.sqrt(2.0 * P / V))
        R0 = np.where(is_pair, V * dt**2 - P, P)
        memory = np.zeros((T, 3, self.looks + 1))
        memory[:, 1, 0], memory[:, 2, 0] = mean[:, 0], 1.0 / P
        memory[:, 0, 1], memory[:, 2, 1] = dt, 1.0 / R0
        memory[:, 1, 1] = mean[:, 0] - mean[:, 1] * dt
        return _fitted(memory)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Return the plane after the times dt (T,) [s]: the line goes on, its points age."""
        memory = _unpacked(mixture).copy()
        memory[:, 0] += dt[:, None]
        return _fitted(memory)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs of the tracks (P,) with the line."""
        return innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Return the plane with the look as a new point of the line."""
        T = len(mixture.mean)
        found = 1.0 - association.miss
        share = association.probability / np.maximum(found, TINY)[track]
        bearing, R, _ = as_data(mixture, track, innovations)
        mean, variance = average(share, bearing, R, track, T)
        memory = _unpacked(mixture).copy()
        is_point = found > MORE_LIKELY_THAN_NOT
        left = (memory[:, 2, :-1] > 0.0).sum(axis=1)
        new = np.flatnonzero(is_point | (left >= _LEAST_POINTS))
        memory[new, :, 1:] = memory[new, :, :-1]
        memory[new, 0, 0] = 0.0
        memory[new, 1, 0] = np.where(is_point, mean, mixture.mean[:, 0, 0])[new]
        weight = np.where(is_point, found / np.where(is_point, variance, 1.0), 0.0)
        memory[new, 2, 0] = weight[new]
        return _fitted(memory)


def _unpacked(mixture: Mixture) -> Floats:
    return mixture.memory.reshape(len(mixture.mean), 3, mixture.memory.shape[1] // 3)


def _fitted(memory: Floats) -> Mixture:
    """Return the weighted line through the points at age 0 (eq. 10 to 14)."""
    age, bearing, weight = memory[:, 0], memory[:, 1], memory[:, 2]
    T = len(memory)
    base = bearing[:, 0]  # small numbers: no cancellation below
    offset = bearing - base[:, None]
    f, g, h = weight.sum(axis=1), (weight * age).sum(axis=1), (weight * age**2).sum(axis=1)
    determinant = f * h - g**2
    a, b = (weight * offset).sum(axis=1), (weight * age * offset).sum(axis=1)
    mean = np.stack([base + (h * a - g * b) / determinant, (g * a - f * b) / determinant], axis=1)
    covariance = np.stack([h, g, g, f], axis=1).reshape(T, 2, 2) / determinant[:, None, None]
    flat = memory.reshape(T, 3 * memory.shape[2])
    return Mixture(mean[:, None], covariance[:, None], np.ones((T, 1)), flat)
