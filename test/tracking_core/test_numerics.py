# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do covariances and probabilities survive numbers that no sane radar would give?"""

from __future__ import annotations

import numpy as np
import pytest

from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.conversion import to_cartesian
from tracking_core.batches import Association, Floats, Measurement, Mixture
from tracking_core.config import with_values
from tracking_core.estimators import Estimator, ESTIMATORS
from tracking_core.linalg import is_positive_definite

CASES, LOOKS = 15_000, 3  # of every estimator: more than 10^5 contacts in all
SPEED_SD = 200.0  # [m/s]
ROUNDING = 1e-12  # of a covariance's largest element


def hostile_noise(rng: np.random.Generator, dimensions: int) -> tuple[Floats, Floats]:
    """Draw plots from 1 m to 10^6 m with range sd from 0.1 m and angle sd up to 5 deg."""
    polar, sd = np.empty((2, CASES, dimensions))
    polar[:, 0] = 10.0 ** rng.uniform(0.0, 6.0, CASES)
    polar[:, 1] = rng.uniform(-np.pi, np.pi, CASES)
    sd[:, 0] = 10.0 ** rng.uniform(-1.0, 3.0, CASES)
    sd[:, 1:] = np.deg2rad(10.0 ** rng.uniform(-2.0, np.log10(5.0), (CASES, dimensions - 1)))
    polar[:, 2:] = rng.uniform(-np.pi / 2, np.pi / 2, (CASES, dimensions - 2))
    polar[::100, 2:] = np.pi / 2  # through the zenith
    return polar, sd


def assert_sound(covariance: Floats) -> None:
    """Symmetric, finite and positive, to the rounding of its largest element."""
    assert np.isfinite(covariance).all()
    flat = covariance.reshape(-1, *covariance.shape[-2:])
    size = np.abs(flat).max(axis=(1, 2))[:, None, None]
    assert np.abs(flat - np.swapaxes(flat, 1, 2)).max() <= ROUNDING * size.max()
    scale = np.sqrt(np.einsum('tii->ti', flat))
    assert (scale > 0.0).all()
    correlation = flat / (scale[:, :, None] * scale[:, None, :])
    assert np.linalg.eigvalsh(correlation).min() >= -ROUNDING


@pytest.mark.parametrize('dimensions', [2, 3])
def test_plot_covariances_are_sound_for_any_noise(dimensions: int) -> None:
    """Range sd 0.1 m with azimuth sd 5 deg at 1000 km, the zenith, and 1 m before the sensor."""
    position, covariance = to_cartesian(*hostile_noise(np.random.default_rng(1), dimensions))
    assert np.isfinite(position).all()
    assert_sound(covariance)


@pytest.mark.parametrize('missed', [0.0, 1e-6, 0.1])
@pytest.mark.parametrize('name', ESTIMATORS)
def test_every_filter_stays_sound(name: str, missed: float) -> None:
    """Times between looks are 0 to 10^4 s, plots lie where they may and far off."""
    rng = np.random.default_rng(2)
    estimator = build_planes(with_values(RadarTrackerConfig(), {'estimator': name}), 2)[
        0
    ].estimator
    mixture, sd = hostile_start(estimator, rng)
    for _ in range(LOOKS):
        silence = np.where(rng.random(CASES) < 0.1, 0.0, 10.0 ** rng.uniform(-3.0, 4.0, CASES))
        mixture = hostile_look(estimator, estimator.predict(mixture, silence), sd, missed, rng)
        assert_sound(mixture.covariance)
        assert np.isfinite(mixture.mean).all()
        probability = mixture.mode_probability
        assert (probability >= 0.0).all()
        assert (probability <= 1.0 + 1e-12).all()
        np.testing.assert_allclose(probability.sum(axis=1), 1.0, atol=1e-12)


def hostile_start(estimator: Estimator, rng: np.random.Generator) -> tuple[Mixture, Floats]:
    """Start contacts at plots of hostile noise; return the noise (CASES, 2) with them."""
    polar, sd = hostile_noise(rng, 2)
    position, R = to_cartesian(polar, sd)
    mean, covariance = np.zeros((CASES, 4)), np.zeros((CASES, 4, 4))
    mean[:, 0::2], covariance[:, 0::2, 0::2] = position, R
    mean[:, 1::2] = rng.normal(0.0, SPEED_SD, (CASES, 2))
    mean[::2, 1::2] = 0.0  # as a start from one plot has it
    covariance[:, 1, 1] = covariance[:, 3, 3] = SPEED_SD**2
    return estimator.start(mean, covariance), sd


def hostile_look(
    estimator: Estimator, predicted: Mixture, sd: Floats, missed: float, rng: np.random.Generator
) -> Mixture:
    """Update with plots at one to ten sigma from the prediction."""
    mean, covariance = predicted.moments()
    spread = np.sqrt(np.einsum('tii->ti', covariance)[:, 0::2])
    aim = mean[:, 0::2] + spread * rng.normal(0.0, 1.0, spread.shape) * rng.choice([1.0, 10.0])
    polar = np.stack([np.hypot(*aim.T), np.arctan2(aim[:, 1], aim[:, 0])], axis=1)
    value, R = to_cartesian(polar, sd)
    H = np.zeros((CASES, 2, 4))
    H[:, [0, 1], [0, 2]] = 1.0
    track = np.arange(CASES)
    innovations = estimator.innovate(
        predicted, track, Measurement(value, H, R, np.zeros(CASES, np.int64))
    )
    chance = np.full(CASES, missed)
    shared = Association(1.0 - chance, chance, np.zeros(CASES, bool))
    return estimator.update(predicted, track, innovations, shared)


def test_what_is_not_positive_is_recognised() -> None:
    """The tracker drops such a track instead of publishing it."""
    bad = np.array([np.diag([1.0, -1e-9]), np.diag([1.0, np.nan]), np.ones((2, 2))])
    assert not is_positive_definite(bad).any()
    assert is_positive_definite(np.diag([1e-9, 1e9])[None]).all()
