# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One track on one axis, plot by plot, for the tests of filters with given gains."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from tracking_core.batches import Association, Measurement, Mixture
from tracking_core.estimators import Estimator

T, SD = 5.0, 100.0  # [s], [m]


@pytest.fixture(scope='session')
def one_axis() -> SimpleNamespace:
    """Return `start` and `look`."""
    return SimpleNamespace(start=start, look=look)


def start(estimator: Estimator, position: float = 0.0, velocity: float = 0.0) -> Mixture:
    """One track on one axis, known as well as two plots tell."""
    P = SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]])
    return estimator.start(np.array([[position, velocity]]), P[None])


def look(estimator: Estimator, mixture: Mixture, z: float | None, dt: float = T) -> Mixture:
    """Predict and update one track on one axis; None is a miss."""
    mixture = estimator.predict(mixture, np.array([dt]))
    count = 0 if z is None else 1
    track = np.zeros(count, np.int64)
    plot = Measurement(
        np.full((count, 1), z, float), np.tile([[[1.0, 0.0]]], (count, 1, 1)),
        np.full((count, 1, 1), SD**2), np.zeros(count, np.int64),
    )  # fmt: skip
    innovations = estimator.innovate(mixture, track, plot)
    shared = Association(np.ones(count), np.full(1, 1.0 - count), np.zeros(1, bool))
    return estimator.update(mixture, track, innovations, shared)
