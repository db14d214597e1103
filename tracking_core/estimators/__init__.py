# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which filter follows a track? One file per alternative, one menu."""

from __future__ import annotations

from typing import Protocol

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.estimators.markov_jump import MarkovJump


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


ESTIMATORS = {'markov_jump': MarkovJump}
