# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One alpha-beta filter that raises its gain when a detector finds a manoeuvre."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.alpha_beta import heard
from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.chances import chi_square_bound
from tracking_core.gain_control import ControlledGain, surprise


@dataclass(frozen=True)
class AdaptiveAlphaBeta:
    """
    The gain falls linearly from `alpha[-1]` to `alpha[0]`, from the start and from each detection.

    A manoeuvre is detected when the normalised innovation squared exceeds its chi-square bound.
    While the gain falls the detector is silent (locked), unless it may start the fall again.
    The innovation covariance is that of the gains and the plots' noise: with `recursion` that of
    the gains that were used, with `steady_state` that of a filter settled at the last one.

    References
    ----------
    [BAKULEV], the filter that the interacting one is compared with.

    """

    alpha: tuple[float, ...]  # quiet, manoeuvre
    axes: int
    covariance: str = 'steady_state'
    false_alarm: float = 1e-3  # of the detector, per look
    ramp: int = 7  # looks in which the gain falls
    restartable: bool = False
    stay_probability: float = 0.9

    @cached_property
    def _filter(self) -> ControlledGain:
        return ControlledGain(
            self.alpha[0], self.alpha[-1], self.axes, self.covariance, self.stay_probability
        )

    @cached_property
    def bound(self) -> float:
        """Chi-square bound of the detector."""
        return chi_square_bound(1.0 - self.false_alarm, self.axes)

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks at the top of the ramp; memory: plots since then."""
        return self._filter.start(mean, covariance, extra=1)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move straight on over the times dt (T,) [s]."""
        return self._filter.predict(mixture, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with the prediction."""
        return self._filter.gains.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Detect, and correct by the gain of the place on the ramp."""
        association = heard(association, track, innovations, self.axes)
        place = self._filter.control(mixture)[:, 0]
        distance = self._distance(place, mixture, track, innovations)
        squared, hit = surprise(distance, track, association)
        listening = np.ones(len(place), bool) if self.restartable else place >= self.ramp
        place = np.where(hit & listening & (squared > self.bound), 0.0, place)
        raised, alpha = self._gain(place)
        single = self._filter.update(mixture, track, innovations, association, alpha)
        place = np.minimum(place + hit, float(self.ramp))
        return self._filter.with_control(single, raised, place[:, None])

    def _gain(self, place: Floats) -> tuple[Floats, Floats]:
        """Return how far the gain is raised, and alpha, at these places of the ramp (T,)."""
        raised = np.clip(1.0 - place / self.ramp, 0.0, 1.0)
        return raised, self.alpha[0] + (self.alpha[-1] - self.alpha[0]) * raised

    def _distance(
        self, place: Floats, mixture: Mixture, track: Ints, innovations: Innovations
    ) -> Floats:
        """Return the normalised innovation squared (P,), plot noise alone considered."""
        if self.covariance == 'recursion':
            return innovations.distance[:, 0]
        _, last = self._gain(place - 1.0)
        return self._filter.settled_distance(mixture, track, innovations, last)
