# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which filter follows a track? One file per alternative, one menu."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.estimators.adaptive_alpha_beta import AdaptiveAlphaBeta
from tracking_core.estimators.alpha_beta import AlphaBeta
from tracking_core.estimators.finite_memory import FiniteMemory
from tracking_core.estimators.fuzzy_alpha_beta import FuzzyAlphaBeta
from tracking_core.estimators.imm_alpha_beta import ImmAlphaBeta
from tracking_core.estimators.kalman_decoupled import DecoupledKalman
from tracking_core.estimators.markov_jump import MarkovJump
from tracking_core.estimators.markov_jump_joint import MarkovJumpJoint
from tracking_core.estimators.modified_polar import ModifiedPolar
from tracking_core.estimators.two_point import TwoPoint

__all__ = [
    'BEARING_ESTIMATORS', 'ESTIMATORS', 'AdaptiveAlphaBeta', 'AlphaBeta', 'DecoupledKalman',
    'Estimator', 'FiniteMemory', 'FuzzyAlphaBeta', 'ImmAlphaBeta', 'MarkovJump', 'MarkovJumpJoint',
    'ModifiedPolar', 'SeesFromSensor', 'TwoPoint',
]  # fmt: skip


class Estimator(Protocol):
    """Filter of one plane, for all tracks at once."""

    @property
    def axes(self) -> int:
        """Number of axes; the state is (position, velocity) on each."""
        ...

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from means (T, n) and covariances (T, n, n)."""
        ...

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Return the plane after the times dt (T,) [s]."""
        ...

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs of the tracks (P,) with the predicted plane."""
        ...

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Return the plane after the plots, each weighted by its association probability."""
        ...


@runtime_checkable
class SeesFromSensor(Protocol):
    """Estimator of a motion relative to the sensor, which must know how that moves."""

    def move_sensor(self, mixture: Mixture, sensor: Floats) -> Mixture:
        """Return the plane with the sensor at x, y, vx, vy (T, 4), after `start` or `predict`."""
        ...


ESTIMATORS = {
    'markov_jump': MarkovJump,
    'markov_jump_joint': MarkovJumpJoint,
    'imm_alpha_beta': ImmAlphaBeta,
    'adaptive_alpha_beta': AdaptiveAlphaBeta,
    'fuzzy_alpha_beta': FuzzyAlphaBeta,
    'two_point': TwoPoint,
    'alpha_beta': AlphaBeta,
}

BEARING_ESTIMATORS = {
    'kalman': MarkovJump,
    'kalman_decoupled': DecoupledKalman,
    'finite_memory': FiniteMemory,
    'modified_polar': ModifiedPolar,
}
