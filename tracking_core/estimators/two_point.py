# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One alpha-beta filter that lives on its last two plots while a manoeuvre is declared."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tracking_core.alpha_beta import heard
from tracking_core.batches import (
    Association,
    Bools,
    Floats,
    Innovations,
    Ints,
    Measurement,
    Mixture,
)
from tracking_core.gain_control import ControlledGain
from tracking_core.linalg import sum_by_track
from tracking_core.manoeuvre_detector import Detector


@dataclass(frozen=True)
class TwoPoint:
    """
    While a manoeuvre is declared: position = plot, velocity = (plot - plot before) / T.

    References
    ----------
    [KHACH02], the filter that the fuzzy one is compared with.

    """

    alpha: tuple[float, ...]  # quiet; the last sizes the gates for manoeuvres
    axes: int
    covariance: str = 'steady_state'
    false_alarm: float = 0.01  # of the detector, per look
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
        """Return new tracks; memory: the detector's, and plot minus estimate of the last look."""
        return self._filter.start(mean, covariance, extra=Detector.COLUMNS + self.axes)

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move straight on over the times dt (T,) [s]."""
        return self._filter.predict(mixture, dt)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with the prediction."""
        return self._filter.gains.innovate(mixture, track, measurement)

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Declare or end a manoeuvre; correct by the quiet gain or by the two-point one."""
        association = heard(association, track, innovations, self.axes)
        memory = self._filter.control(mixture)
        kept, off = memory[:, : Detector.COLUMNS], memory[:, Detector.COLUMNS :]
        said = self._detector.judge(kept, mixture, track, innovations, association)
        alpha = np.where(said.declared, 1.0, self.alpha[0])  # alpha = 1 has beta = 1
        single = self._filter.update(mixture, track, innovations, association, alpha)
        single = self._from_the_plot_before(single, mixture, off, said.declared, association)
        nu = innovations.innovation[:, 0, : self.axes] * association.probability[:, None]
        mean_nu = sum_by_track(nu, track, len(off))
        moved = single.mean[:, 0, 0::2] - mixture.mean[:, 0, 0::2]
        off = mean_nu - moved + association.miss[:, None] * off
        return self._filter.with_control(
            single, said.declared.astype(np.float64), np.concatenate([said.memory, off], axis=1)
        )

    def _from_the_plot_before(
        self,
        single: Mixture,
        predicted: Mixture,
        off: Floats,
        declared: Bools,
        association: Association,
    ) -> Mixture:
        """Reckon the velocity from the plot before, not from the estimate before."""
        gains, a = self._filter.gains, self.axes
        interval = gains.interval(predicted)
        share = np.where(declared & (interval > 0.0), 1.0 - association.miss, 0.0)
        share = share / np.where(interval > 0.0, interval, 1.0)  # per second
        mean, covariance = single.mean.copy(), single.covariance.copy()
        mean[:, 0, 1::2] -= share[:, None] * off
        smoothed = (off != 0.0).any(axis=1)  # else the estimate before was the plot
        vaguer = (1.0 - self.alpha[0]) * gains.plot_noise(single)
        index = 2 * np.arange(a) + 1
        covariance[:, 0, index[:, None], index] += (share**2 * smoothed)[:, None, None] * vaguer
        return replace(single, mean=mean, covariance=covariance)
