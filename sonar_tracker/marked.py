# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which mark did each track have in its last look? A filter that keeps it beside its state."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.chances import MORE_LIKELY_THAN_NOT, TINY
from tracking_core.estimators import Estimator, SeesFromSensor
from tracking_core.linalg import sum_by_track
from tracking_core.marks import as_data, average

_COLUMNS = 2  # of `Mixture.memory`, the last ones: bearing [rad], weight [1/rad^2]
_ALONE = 0.1  # marks that follow the track by less or more than 1 by this are of others too


@dataclass(frozen=True)
class Marked:
    """
    Any filter of bearings, with the mark of the last look in the last columns of the memory.

    The mark is the mean of the marks by association probability, its weight the probability that
    there was one over the variance of that mean as a measurement: it is data, not an estimate.
    A mark that belongs to several contacts is none of one of them: its weight is 0.
    """

    estimator: Estimator

    @property
    def axes(self) -> int:
        """One: the bearing."""
        return self.estimator.axes

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks, without a mark."""
        return _with(self.estimator.start(mean, covariance), _nothing(len(mean)))

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Return the plane after the times dt (T,) [s], without a mark."""
        predicted = self.estimator.predict(_without(mixture), dt)
        return _with(predicted, _nothing(len(mixture.mean)))

    def move_sensor(self, mixture: Mixture, sensor: Floats) -> Mixture:
        """Return the plane with the sensor at x, y, vx, vy (T, 4)."""
        if self._moving is None:
            return mixture
        moved = self._moving.move_sensor(_without(mixture), sensor)
        return _with(moved, mixture.memory[:, -_COLUMNS:])

    @cached_property
    def _moving(self) -> SeesFromSensor | None:
        return self.estimator if isinstance(self.estimator, SeesFromSensor) else None

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs of the tracks (P,) with the predicted plane."""
        return self.estimator.innovate(_without(mixture), track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Return the plane after the marks, and the mark that they are together."""
        plane = _without(mixture)
        updated = self.estimator.update(plane, track, innovations, association)
        return _with(updated, _mark(plane, track, innovations, association))


def last_marks(mixture: Mixture) -> tuple[Floats, Floats]:
    """Return bearing [rad] and weight [1/rad^2], 0: none, of the last look's marks (T,)."""
    return mixture.memory[:, -2], mixture.memory[:, -1]


def _mark(
    mixture: Mixture, track: Ints, innovations: Innovations, association: Association
) -> Floats:
    T = len(mixture.mean)
    bearing, R, h = as_data(mixture, track, innovations)
    found = sum_by_track(association.probability, track, T)
    share = association.probability / np.maximum(found, TINY)[track]
    mean, variance = average(share, bearing, R, track, T)
    alone = sum_by_track(share * (np.abs(h - 1.0) < _ALONE), track, T)
    told = (found > MORE_LIKELY_THAN_NOT) & (alone > MORE_LIKELY_THAN_NOT) & (variance > 0.0)
    weight = np.where(told, found / np.where(told, variance, 1.0), 0.0)
    return np.stack([mean, weight], axis=1)


def _nothing(T: int) -> Floats:
    return np.zeros((T, _COLUMNS))


def _without(mixture: Mixture) -> Mixture:
    return replace(mixture, memory=mixture.memory[:, :-_COLUMNS])


def _with(mixture: Mixture, mark: Floats) -> Mixture:
    return replace(mixture, memory=np.concatenate([mixture.memory, mark], axis=1))
