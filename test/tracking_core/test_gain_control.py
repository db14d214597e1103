# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Filters that change their gain, or mix several, against what they should do plot by plot."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.batches import Association, Measurement
from tracking_core.estimators import (
    AdaptiveAlphaBeta,
    AlphaBeta,
    Estimator,
    FuzzyAlphaBeta,
    ImmAlphaBeta,
    TwoPoint,
)
from tracking_core.gains import noise_gain, steady_noise

T, SD = 5.0, 100.0
ALPHA = 0.6
H = np.array([[1.0, 0.0]])


def states(one_axis, estimator: Estimator, plots: list[float]) -> np.ndarray:
    """Position and velocity after each plot."""
    mixture, result = one_axis.start(estimator), []
    for z in plots:
        mixture = one_axis.look(estimator, mixture, z)
        result.append(mixture.moments()[0][0])
    return np.array(result)


def textbook_imm(plots: np.ndarray, alpha: tuple[float, ...], reading: str):
    """[BAKULEV] eq. 8 to 16 written out for one axis; yields mode probabilities and mean."""
    J, F = len(alpha), np.array([[1.0, T], [0.0, 1.0]])
    Pi = np.array([[0.9, 0.1], [0.1, 0.9]])
    x = [np.zeros(2) for _ in alpha]
    P = [SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]]) for _ in alpha]
    mu = np.full(J, 0.5)
    for z in plots:
        prior = mu @ Pi
        new_x, new_P, like = [], [], []
        for j in range(J):
            w = mu * Pi[:, j] / prior[j]
            x0 = sum(w[i] * x[i] for i in range(J))
            P0 = sum(w[i] * (P[i] + np.outer(x[i] - x0, x[i] - x0)) for i in range(J))
            K = np.array([[alpha[j]], [alpha[j] ** 2 / (2.0 - alpha[j]) / T]])
            xp, Pp, joseph = F @ x0, F @ P0 @ F.T, np.eye(2) - K @ H
            S = Pp[0, 0] + SD**2 if reading == 'recursion' else SD**2 / (1.0 - alpha[j])
            new_x.append(xp + K[:, 0] * (z - xp[0]))
            new_P.append(joseph @ Pp @ joseph.T + SD**2 * K @ K.T)
            like.append(np.exp(-0.5 * (z - xp[0]) ** 2 / S) / np.sqrt(2.0 * np.pi * S))
        x, P, mu = new_x, new_P, prior * np.array(like)
        mu = mu / mu.sum()
        yield mu, sum(mu[j] * x[j] for j in range(J))


@pytest.mark.parametrize('reading', ['recursion', 'steady_state'])
def test_imm_alpha_beta_equals_the_textbook_loop(one_axis, reading: str) -> None:
    """Both readings; the settled one once it has settled from a start with the settled mean."""
    alpha, rng = (0.3, 0.7), np.random.default_rng(5)
    plots = np.concatenate([np.zeros(60), 40.0 * np.arange(10) ** 2 + rng.normal(0.0, SD, 10)])
    estimator = ImmAlphaBeta(alpha, 1, reading)
    mixture = one_axis.start(estimator)
    for k, (mu, x) in enumerate(textbook_imm(plots, alpha, reading)):
        mixture = one_axis.look(estimator, mixture, plots[k])
        if k > (60 if reading == 'steady_state' else 0):
            assert_allclose(mixture.mode_probability[0], mu, atol=1e-6)
            assert_allclose(mixture.moments()[0][0], x, rtol=1e-6)


def test_two_point_lives_on_the_last_two_plots_in_a_manoeuvre(one_axis) -> None:
    """Position = plot, velocity = (plot - plot before) / T, from the first declared plot on."""
    plots = [0.0, 10.0, 900.0, 2000.0]
    found = states(one_axis, TwoPoint((ALPHA, 0.7), 1), plots)
    assert_allclose(found[2], [900.0, (900.0 - 10.0) / T], rtol=1e-9)
    assert_allclose(found[3], [2000.0, (2000.0 - 900.0) / T], rtol=1e-9)
    assert abs(found[1, 0] - 10.0) > 1.0  # smoothed while quiet


def test_two_point_has_the_covariance_of_two_plots(one_axis) -> None:
    """R, R / T, 2 R / T^2 with plot noise alone, once settled."""
    estimator = TwoPoint((ALPHA, 0.7), 1, 'recursion')
    mixture = one_axis.start(estimator)
    for z in (0.0, 10.0, 900.0, 2000.0):
        mixture = one_axis.look(estimator, mixture, z)
    expected = SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]])
    assert_allclose(mixture.covariance[0, 0], expected, rtol=1e-9)


def test_two_point_is_as_vague_at_the_first_plot_of_a_manoeuvre(one_axis) -> None:
    """2 R / T^2 and the noise of the quiet gain; the estimate before would be surer."""
    estimator = TwoPoint((ALPHA, 0.7), 1)
    mixture = one_axis.start(estimator)
    for _ in range(60):
        mixture = one_axis.look(estimator, mixture, 0.0)
    mixture = one_axis.look(estimator, one_axis.look(estimator, mixture, 1.0), 3.8 * SD)
    assert mixture.mode_probability[0, 1] == 1.0
    expected = SD**2 / T**2 * (2.0 + steady_noise(ALPHA)[0, 0])
    assert mixture.covariance[0, 0, 1, 1] == pytest.approx(expected, rel=1e-6)


def gains_used(one_axis, estimator: Estimator, plots: list[float]) -> list[float]:
    """Return alpha of each look: how much of the innovation the position took."""
    mixture, used = one_axis.start(estimator), []
    for z in plots:
        before = estimator.predict(mixture, np.array([T])).mean[0, 0, 0]
        mixture = one_axis.look(estimator, mixture, z)
        used.append((mixture.mean[0, 0, 0] - before) / (z - before))
    return used


def test_adaptive_gain_falls_in_a_ramp_from_the_start(one_axis) -> None:
    """alpha2 at the first plot, alpha1 at the eighth, linear between."""
    used = gains_used(one_axis, AdaptiveAlphaBeta((0.3, 0.7), 1, 'recursion'), [3.0] * 10)
    assert_allclose(used, [*np.linspace(0.7, 0.3, 8), 0.3, 0.3], atol=1e-9)


@pytest.mark.parametrize(('restartable', 'second'), [(False, 0.7 - 0.4 / 7.0), (True, 0.7)])
def test_adaptive_gain_is_raised_by_a_detection(
    one_axis, restartable: bool, second: float
) -> None:
    """A far plot starts the ramp again; a second one only if the ramp is not locked."""
    estimator = AdaptiveAlphaBeta((0.3, 0.7), 1, 'recursion', restartable=restartable)
    used = gains_used(one_axis, estimator, [3.0] * 10 + [5000.0, -20000.0])
    assert_allclose(used[10:], [0.7, second], atol=1e-9)


def test_fuzzy_gain_is_quiet_until_a_manoeuvre_and_after_two_calm_plots(one_axis) -> None:
    """Raised by the declaring plot and the first calm one, not by the second."""
    estimator = FuzzyAlphaBeta((ALPHA, 0.7), 1)
    plots = [3.0, -3.0, 700.0, 1500.0, 2400.0, 3400.0, 4400.0, 5400.0, 6400.0]
    used = gains_used(one_axis, estimator, plots)
    bound = np.sqrt(1.0 + noise_gain(ALPHA)) * 2.5758 * SD
    mixture, calm = one_axis.start(estimator), 0
    for z, gain in zip(plots, used, strict=True):
        before = estimator.predict(mixture, np.array([T])).mean[0, 0, 0]
        mixture = one_axis.look(estimator, mixture, z)
        calm = 0 if abs(z - before) > bound else calm + 1
        assert (gain > ALPHA + 1e-6) == (z >= 700.0 and calm < 2)
    assert used[-1] == pytest.approx(ALPHA)


def test_fuzzy_gain_is_one_rule_exactly(one_axis) -> None:
    """Now large, before very small: alpha + (1 - alpha) 5/6, the centre of the set large."""
    estimator = FuzzyAlphaBeta((ALPHA, 0.7), 1)
    used = gains_used(one_axis, estimator, [1e-9, 50.0 * SD])
    assert used[1] == pytest.approx(ALPHA + (1.0 - ALPHA) * 5.0 / 6.0, abs=1e-4)


@pytest.mark.parametrize('kind', [FuzzyAlphaBeta, TwoPoint])
def test_detector_has_its_false_alarm_rate(kind) -> None:
    """On a straight path 1 % of the plots of a quiet filter are beyond the bound, on 2 too."""
    rng, runs = np.random.default_rng(9), 4000
    for axes in (1, 2):
        estimator = kind((0.3, 0.7), axes)
        P = np.kron(np.eye(axes), SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]]))
        mixture = estimator.start(np.zeros((runs, 2 * axes)), np.tile(P, (runs, 1, 1)))
        matrix = np.broadcast_to(np.eye(2 * axes)[0::2], (runs, axes, 2 * axes))
        sure = Association(np.ones(runs), np.zeros(runs), np.zeros(runs, bool))
        R, rate = np.tile(SD**2 * np.eye(axes), (runs, 1, 1)), []
        quiet = np.ones(runs, bool)  # a filter with a raised gain is not settled
        for _ in range(40):
            mixture = estimator.predict(mixture, np.full(runs, T))
            plots = Measurement(
                rng.normal(0.0, SD, (runs, axes)), matrix, R, np.zeros(runs, np.int64)
            )
            seen = estimator.innovate(mixture, np.arange(runs), plots)
            mixture = estimator.update(mixture, np.arange(runs), seen, sure)
            declared = mixture.mode_probability[:, 1] > 0.0
            rate.append(declared[quiet].mean())
            quiet &= ~declared
        assert np.mean(rate[20:]) == pytest.approx(0.01, abs=0.0025)


@pytest.mark.parametrize('with_rate', [False, True])
def test_adaptive_detector_has_its_false_alarm_rate(with_rate: bool) -> None:
    """Of the plots of a settled filter on a straight path 1 %, with a range rate as without."""
    rng, runs, d = np.random.default_rng(9), 4000, 2 + with_rate
    estimator = AdaptiveAlphaBeta((0.3, 0.7), 2, 'recursion', false_alarm=0.01)
    P = np.kron(np.eye(2), SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]]))
    mixture = estimator.start(np.zeros((runs, 4)), np.tile(P, (runs, 1, 1)))
    matrix = np.broadcast_to(np.eye(4)[[0, 2, 1]][:d], (runs, d, 4))  # of a contact in the east
    sure = Association(np.ones(runs), np.zeros(runs), np.zeros(runs, bool))
    sd, rate, quiet = np.array([SD, SD, 2.0])[:d], [], np.ones(runs, bool)
    R, absent = np.tile(np.diag(sd**2), (runs, 1, 1)), np.zeros(runs, np.int64)
    for look in range(60):
        mixture = estimator.predict(mixture, np.full(runs, T))
        plots = Measurement(rng.normal(0.0, sd, (runs, d)), matrix, R, absent)
        seen = estimator.innovate(mixture, np.arange(runs), plots)
        mixture = estimator.update(mixture, np.arange(runs), seen, sure)
        if look > 30:
            found = mixture.mode_probability[:, 1] == 1.0
            rate.append(found[quiet].mean())
            quiet &= ~found
    assert np.mean(rate) == pytest.approx(0.01, abs=0.0015)


def test_second_mode_opens_the_gate_for_what_the_detector_waits_for(one_axis) -> None:
    """A plot at the detector's bound lies within 3 sigma of the manoeuvre mode."""
    estimator = AdaptiveAlphaBeta((0.3, 0.7), 1)
    mixture = one_axis.start(estimator)
    for _ in range(30):
        mixture = one_axis.look(estimator, mixture, 0.0)
    predicted = estimator.predict(mixture, np.array([T]))
    quiet, vague = np.sqrt(predicted.covariance[0, :, 0, 0] + SD**2)
    assert np.sqrt(estimator.bound) * quiet < 3.0 * vague
    assert_allclose(predicted.mode_probability, [[0.9, 0.1]])


def test_imm_of_one_gain_is_the_plain_filter(one_axis) -> None:
    """One mode: nothing to mix."""
    one, plain = ImmAlphaBeta((ALPHA,), 1), AlphaBeta(ALPHA, 1)
    ours, theirs = (one_axis.start(estimator) for estimator in (one, plain))
    for z in (50.0, -300.0, 2000.0):
        ours, theirs = one_axis.look(one, ours, z), one_axis.look(plain, theirs, z)
    assert_allclose(ours.mean, theirs.mean, rtol=1e-12)
    assert_allclose(ours.covariance, theirs.covariance, rtol=1e-9)
