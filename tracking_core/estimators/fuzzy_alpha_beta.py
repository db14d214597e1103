# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One alpha-beta filter whose gain fuzzy rules raise while a manoeuvre is declared."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from tracking_core.alpha_beta import heard
from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.fuzzy import KHACHATUROV, Rules
from tracking_core.gain_control import ControlledGain
from tracking_core.manoeuvre_detector import Detector


@dataclass(frozen=True)
class FuzzyAlphaBeta:
    """
    While a manoeuvre is declared, alpha + (1 - alpha) omega, omega from the rules.

    What the rules look at is the normalised innovation, now and at the plot before.

    References
    ----------
    [KHACH02] eq. 3 to 6 and the rule table.

    """

    alpha: tuple[float, ...]  # quiet; the last sizes the gates for manoeuvres
    axes: int
    covariance: str = 'steady_state'
    false_alarm: float = 0.01  # of the detector, per look
    rules: Rules = field(default_factory=lambda: KHACHATUROV)
    stay_probability: float = 0.9

    @cached_property
    def _filter(self) -> ControlledGain:
        return ControlledGain(
            self.alpha[0], self.alpha[-1], self.axes, self.covariance, self.stay_probability
        )

    @cached_property
    def _detector(self) -> Detector:
        return Detector(self._filter, self.false_alarm)

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks, no manoeuvre declared."""
        return self._filter.start(mean, covariance, extra=Detector.COLUMNS)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move straight on over the times dt (T,) [s]."""
        return self._filter.predict(mixture, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with the prediction."""
        return self._filter.gains.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Declare or end a manoeuvre, infer the gain, correct."""
        association = heard(association, track, innovations, self.axes)
        memory = self._filter.control(mixture)
        said = self._detector.judge(memory, mixture, track, innovations, association)
        omega = np.where(said.declared, self.rules.infer(said.before, said.now), 0.0)
        alpha = self.alpha[0] + (1.0 - self.alpha[0]) * omega
        single = self._filter.update(mixture, track, innovations, association, alpha)
        return self._filter.with_control(single, omega, said.memory)
