# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Misprints of the papers: what is printed cannot be meant. docs/errata.md names each test."""

from __future__ import annotations

from pathlib import Path
import re

import numpy as np
from numpy.testing import assert_allclose
import pytest
from scipy.stats import chi2, multivariate_normal

from tracking_core.kalman import from_innovation

ROOT = Path(__file__).parents[2]
RNG = np.random.default_rng(7)


def test_likelihood_of_zhuk_eq_24_needs_minus_inverse_and_dimension() -> None:
    """The right form is the Gaussian density for every d; the printed one grows with distance."""
    for d in (1, 2, 3):
        root = RNG.normal(0.0, 1.0, (d, d))
        S = root @ root.T + np.eye(d)
        nu = RNG.normal(0.0, 2.0, (5, 1, d))
        ours = from_innovation(
            nu,
            np.tile(S, (5, 1, 1, 1)),
            np.zeros((5, 1, 4, d)),
            np.tile(S, (5, 1, 1)),
            np.zeros(5, np.int64),
        ).log_likelihood[:, 0]
        assert_allclose(ours, multivariate_normal(cov=S).logpdf(nu[:, 0]), rtol=1e-9)
        near, far = np.array([[0.1] * d, [10.0] * d])
        printed = [0.5 * x @ S @ x - 0.5 * np.log(np.linalg.det(S)) for x in (near, far)]
        assert printed[1] > printed[0]
    # (2 pi)^-1 is the normalisation of d = 2 alone: in the vertical plane it is off by a root.
    grid = np.linspace(-40.0, 40.0, 8001)
    density = np.exp(-0.5 * grid**2 / 4.0) / (2.0 * np.pi * np.sqrt(4.0))
    assert density.sum() * 0.01 == pytest.approx(1.0 / np.sqrt(2.0 * np.pi), rel=1e-6)


def test_covariance_of_zhuk_eq_20_needs_the_same_motion_on_both_sides() -> None:
    """F_j P F_i^T is not even symmetric where the motions differ."""
    turn = np.deg2rad(60.0)
    F_i, F_j = np.eye(2), np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    P = np.diag([4.0, 1.0])
    printed = F_j @ P @ F_i.T
    assert np.abs(printed - printed.T).max() > 1.0
    sample = RNG.multivariate_normal([0.0, 0.0], P, 200_000) @ F_j.T
    assert_allclose(F_j @ P @ F_j.T, np.cov(sample.T), atol=0.05)


def test_gate_of_zhuk_must_not_look_at_its_own_plot() -> None:
    """
    Choosing the wider mode when the plot lies far makes the gate hold whatever it is asked about.

    Two modes of sd 1 and 10: a 3-sigma gate of the mode that the plot favours lets pass a plot
    beyond 3 sigma of the predicted mixture.
    """
    sd, prior, plot = np.array([1.0, 10.0]), np.array([0.99, 0.01]), 15.0
    posterior = prior * np.exp(-0.5 * (plot / sd) ** 2) / sd
    favoured = sd[np.argmax(posterior)]
    mixture = np.sqrt(prior @ sd**2)
    assert abs(plot) < 3.0 * favoured
    assert abs(plot) > 3.0 * mixture


def test_gate_of_voronina_eq_3_is_a_chi_square_bound() -> None:
    """2.5 is printed for 0.9; that is 2.706, and 2.5 holds 0.886."""
    assert chi2(1).ppf(0.9) == pytest.approx(2.706, abs=1e-3)
    assert chi2(1).cdf(2.5) == pytest.approx(0.886, abs=1e-3)


def mixture_of_marks() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Weights (the first: no mark), estimates and variances of one track."""
    return np.array([0.3, 0.5, 0.2]), np.array([10.0, 10.4, 9.0]), np.array([0.5, 0.2, 0.2])


def test_estimate_of_voronina_eq_4_needs_the_prediction() -> None:
    """Without beta_0 times the prediction the bearing is drawn towards zero."""
    weight, estimate, _ = mixture_of_marks()
    printed = weight[1:] @ estimate[1:]
    assert weight @ estimate == pytest.approx(10.0)
    assert printed < 8.0


def test_covariance_of_voronina_eq_5_subtracts_the_mean_once() -> None:
    """Print subtracts it once per mark: the variance is negative for an ordinary bearing."""
    weight, estimate, variance = mixture_of_marks()
    mean = weight @ estimate
    right = weight @ (variance + estimate**2) - mean**2
    printed = sum(w * (v + x**2) - mean**2 for w, v, x in zip(
        weight, variance, estimate, strict=True))  # fmt: skip
    drawn = RNG.choice(3, 400_000, p=weight)
    sample = RNG.normal(estimate[drawn], np.sqrt(variance[drawn]))
    assert right == pytest.approx(sample.var(), rel=0.02)
    assert printed < 0.0


def test_variance_of_voronina_eq_8_is_m_minus_m_squared_over_s() -> None:
    """M = s_a^2 + s_V^2 dT^2 + q, S = M + s_z^2: the variance of the weighted mean of both."""
    s_a, s_V, dT, q, s_z = 0.1, 0.02, 2.0, 2.5e-5, 0.2
    M = s_a**2 + (s_V * dT) ** 2 + q
    assert M - M**2 / (M + s_z**2) == pytest.approx(1.0 / (1.0 / M + 1.0 / s_z**2))


def test_rate_error_of_voronina_eq_12_has_f_in_it() -> None:
    """s_V = sqrt(f / D) / dT, not sqrt(g / D) / dT: 1.356e-3 deg/s for K' = 15, 0.05 deg, 2 s."""
    sd, back = 0.05, np.arange(16.0)  # this cycle and the 15 before it
    f, g, h = (np.sum(back**power) / sd**2 for power in range(3))
    D = f * h - g * g
    rate_sd = np.sqrt(f / D) / 2.0
    assert rate_sd == pytest.approx(1.356e-3, rel=0.02)
    assert np.sqrt((h + 2.0 * g + f) / D) == pytest.approx(0.0262, abs=0.0003)
    marks = RNG.normal(0.0, sd, (16, 20_000))
    found = np.polynomial.polynomial.polyfit(-2.0 * back, marks, 1)[1].std()
    assert found == pytest.approx(rate_sd, rel=0.02)
    assert np.sqrt(g / D) / 2.0 > 2.0 * found


def test_ratio_of_voronina_eq_15_is_one_without_a_mark() -> None:
    """No mark: s_post / s_pred is 1; with one it is below: print has < for >."""
    prediction, mark = 0.3, 0.2
    with_mark = np.sqrt(1.0 / (1.0 / prediction**2 + 1.0 / mark**2)) / prediction
    assert with_mark < 0.6
    weight = np.array([1.0, 0.0])
    without = np.sqrt(weight @ np.array([prediction**2, (with_mark * prediction) ** 2]))
    assert without / prediction >= 0.9999


def test_time_of_voronina_eq_16_is_halved_by_one_break() -> None:
    """Mean length of segments over the interval: 0.5 for a track that misses one cycle."""
    held = np.ones(501, bool)
    held[250] = False
    edges = np.flatnonzero(np.diff(np.concatenate([[0], held, [0]])))
    segments = edges[1::2] - edges[0::2]
    assert segments.mean() / len(held) == pytest.approx(0.5, abs=0.01)
    assert held.mean() > 0.99


def named_tests() -> list[str]:
    """Return the test ids in docs/errata.md."""
    return re.findall(r'`(test/[\w/]+\.py::\w+)`', (ROOT / 'docs' / 'errata.md').read_text())


def test_errata_name_their_tests() -> None:
    """At least one for each misprint."""
    assert len(named_tests()) >= 16


@pytest.mark.parametrize('name', named_tests())
def test_test_named_in_errata_exists(name: str) -> None:
    """File and function are there."""
    path, function = name.split('::')
    assert re.search(rf'^def {function}\(', (ROOT / path).read_text(), re.MULTILINE)
