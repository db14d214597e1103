# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The filters with given gains against plain loops, and their covariances against Kalman's."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.alpha_beta import GainFilter
from tracking_core.batches import Association, Measurement
from tracking_core.estimators import (
    AlphaBeta,
    ImmAlphaBeta,
)
from tracking_core.gains import noise_gain, steady_covariance, steady_noise
from tracking_core.measurement import without_absent

T, SD = 5.0, 100.0
ALPHA, BETA = 0.6, 0.36 / 1.4
H = np.array([[1.0, 0.0]])


def test_alpha_beta_equals_the_textbook_loop(one_axis) -> None:
    """Position, velocity, and (I - K H) P (I - K H)^T + K R K^T."""
    plots = np.random.default_rng(1).normal(0.0, 200.0, 12)
    x, P = np.zeros(2), SD**2 * np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]])
    F, K = np.array([[1.0, T], [0.0, 1.0]]), np.array([[ALPHA], [BETA / T]])
    estimator = AlphaBeta(ALPHA, 1, 'recursion')
    mixture = one_axis.start(estimator)
    for z in plots:
        x, P = F @ x, F @ P @ F.T
        x, joseph = x + K[:, 0] * (z - x[0]), np.eye(2) - K @ H
        P = joseph @ P @ joseph.T + SD**2 * K @ K.T
        mixture = one_axis.look(estimator, mixture, z)
        assert_allclose(mixture.mean[0, 0], x, rtol=1e-12)
        assert_allclose(mixture.covariance[0, 0], P, rtol=1e-10)


def test_recursion_settles_at_the_printed_innovation_variance(one_axis) -> None:
    """[KHACH02] 1 + (2 a^2 + a b + 2 b) / (a (4 - 2 a - b)), 1.382^2 for alpha 0.6."""
    estimator = AlphaBeta(ALPHA, 1, 'recursion')
    mixture = one_axis.start(estimator)
    for _ in range(60):
        mixture = one_axis.look(estimator, mixture, 0.0)
    predicted = estimator.predict(mixture, np.array([T]))
    assert_allclose(predicted.covariance[0, 0, 0, 0] / SD**2, noise_gain(ALPHA), rtol=1e-9)
    assert np.sqrt(1.0 + noise_gain(ALPHA)) == pytest.approx(1.382, abs=1e-3)


@pytest.mark.parametrize('alpha', [0.05, 0.3, 0.7, 0.95])
def test_steady_state_has_the_gain_of_a_kalman_filter(alpha: float) -> None:
    """With the noise of `steady_noise` the Kalman gain settles at (alpha, beta)."""
    F, Q, P = np.array([[1.0, 1.0], [0.0, 1.0]]), steady_noise(alpha), 10.0 * np.eye(2)
    assert np.linalg.eigvalsh(Q).min() > -1e-12
    for _ in range(3000):
        before = F @ P @ F.T + Q
        K = before @ H.T / (before[0, 0] + 1.0)
        P = before - K @ H @ before
    assert_allclose(K[:, 0], [alpha, alpha**2 / (2.0 - alpha)], rtol=1e-6)
    assert_allclose(before[0, 0] + 1.0, 1.0 / (1.0 - alpha), rtol=1e-6)
    assert_allclose(steady_covariance(alpha), [before, P], rtol=1e-6)


@pytest.mark.parametrize('alpha', [0.3, 0.7])
def test_steady_state_settles_at_r_over_one_minus_alpha(one_axis, alpha: float) -> None:
    """S = R / (1 - alpha), in every mode of the interacting filters too."""
    for estimator in (AlphaBeta(alpha, 1), ImmAlphaBeta((alpha, alpha), 1)):
        mixture = one_axis.start(estimator)
        for _ in range(60):
            mixture = one_axis.look(estimator, mixture, 0.0)
        S = estimator.predict(mixture, np.array([T])).covariance[0, :, 0, 0] + SD**2
        assert_allclose(S, SD**2 / (1.0 - alpha), rtol=1e-6)


@pytest.mark.parametrize('estimator', [AlphaBeta(0.3, 1), ImmAlphaBeta((0.3, 0.7), 1)])
def test_first_plot_tells_the_velocity_of_a_start_at_rest(one_axis, estimator) -> None:
    """With a wide prior the filter goes on as from two points, after a miss too."""
    prior = np.diag([SD**2, 1e4**2])[None]
    start = estimator.start(np.zeros((1, 2)), prior)
    for before, dt in ((start, T), (one_axis.look(estimator, start, None), 2.0 * T)):
        after = one_axis.look(estimator, before, 600.0)
        assert_allclose(after.mean[0], [[600.0, 600.0 / dt]] * after.mean.shape[1], rtol=1e-3)
    second = one_axis.look(estimator, one_axis.look(estimator, start, 600.0), 1300.0)
    assert_allclose(second.mean[0, 0, 0], 1200.0 + 0.3 * 100.0, rtol=2e-3)


def test_velocity_gain_counts_the_time_since_the_last_plot(one_axis) -> None:
    """After a miss the velocity is corrected by beta / (2 T)."""
    estimator = AlphaBeta(ALPHA, 1)
    mixture = one_axis.look(
        estimator, one_axis.look(estimator, one_axis.start(estimator), None), 1000.0
    )
    assert_allclose(mixture.mean[0, 0], [ALPHA * 1000.0, BETA * 1000.0 / (2.0 * T)], rtol=1e-12)
    again = one_axis.look(estimator, mixture, None, 0.0)
    assert_allclose(again.mean, mixture.mean)


def test_no_time_between_two_plots_leaves_the_velocity_alone(one_axis) -> None:
    """Two plots at the same time say nothing about velocity, and nothing becomes infinite."""
    estimator = AlphaBeta(ALPHA, 1)
    mixture = one_axis.look(estimator, one_axis.start(estimator, 0.0, 7.0), 10.0, 0.0)
    assert mixture.mean[0, 0, 1] == 7.0
    assert np.isfinite(mixture.covariance).all()


def test_gains_leave_alone_what_a_plot_does_not_measure(one_axis) -> None:
    """An absent height changes nothing; a range rate has no gain."""
    gains = GainFilter((ALPHA,), 1)
    predicted = gains.predict(one_axis.start(gains, 50.0, 3.0), np.array([T]))
    estimator, sure = AlphaBeta(ALPHA, 1), Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    matrix = np.array([[[0.0, 0.0], [0.0, 0.6]]])
    plot = Measurement(np.array([[0.0, 40.0]]), matrix, np.eye(2)[None], np.ones(1, np.int64))
    row = np.zeros(1, np.int64)
    after = estimator.update(predicted, row, estimator.innovate(predicted, row, plot), sure)
    assert_allclose(after.mean, predicted.mean)
    assert_allclose(after.covariance, predicted.covariance)
    assert_allclose(gains.plot_noise(after), [[[SD**2]]])


def test_gains_leave_alone_the_axis_that_a_plot_does_not_have() -> None:
    """Of two axes one is measured: the other keeps mean, variance and plot noise."""
    estimator, gains = AlphaBeta(ALPHA, 2), GainFilter((ALPHA,), 2)
    P = SD**2 * np.kron(np.eye(2), np.array([[1.0, 1.0 / T], [1.0 / T, 2.0 / T**2]]))
    first = estimator.start(np.array([[0.0, 3.0, 0.0, 4.0]]), P[None])
    predicted, row = estimator.predict(first, np.array([T])), np.zeros(1, np.int64)
    matrix = np.zeros((1, 2, 4))
    matrix[0, 0, 0] = 1.0
    R = np.diag([0.25 * SD**2, 1.0])[None]
    plot = Measurement(np.array([[100.0, 0.0]]), matrix, R, np.ones(1, np.int64))
    sure = Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    after = estimator.update(predicted, row, estimator.innovate(predicted, row, plot), sure)
    assert after.mean[0, 0, 0] == pytest.approx(15.0 + ALPHA * 85.0)
    assert_allclose(after.mean[0, 0, 2:], predicted.mean[0, 0, 2:])
    assert_allclose(after.covariance[0, 0, 2:, 2:], predicted.covariance[0, 0, 2:, 2:])
    assert_allclose(np.diag(gains.plot_noise(after)[0]), [0.25 * SD**2, SD**2])


@pytest.mark.parametrize('alpha', [(), (0.0, 0.5), (0.3, 1.0)])
def test_gains_outside_their_limits_are_refused(alpha: tuple[float, ...]) -> None:
    """Gains of 0 and 1 have no settled covariance."""
    with pytest.raises(ValueError, match=r'alpha must be in \(0, 1\), one per mode'):
        GainFilter(alpha, 1)


def test_unknown_reading_of_the_covariance_is_refused() -> None:
    """The message names the two that there are."""
    with pytest.raises(ValueError, match=r"one of \('steady_state', 'recursion'\), got 'steady'"):
        AlphaBeta(0.5, 1, 'steady')._gains  # noqa: B018
    with pytest.raises(ValueError, match=r'stay_probability must be in \(0, 1\), got 1'):
        ImmAlphaBeta((0.3, 0.7), 1, 'recursion', 1.0)


@pytest.mark.parametrize('far', [5.0, 15.0])
def test_lag_that_an_innovation_betrays_is_in_the_covariance(one_axis, far: float) -> None:
    """An acceleration over the last look leaves the same share in error and in covariance."""
    estimator = AlphaBeta(ALPHA, 1)
    mixture = one_axis.start(estimator)
    for _ in range(40):
        mixture = one_axis.look(estimator, mixture, 0.0)
    push = far * SD / np.sqrt(1.0 - ALPHA)  # innovation, `far` times its sd
    S = SD**2 / (1.0 - ALPHA)
    quiet, surprised = (one_axis.look(estimator, mixture, z) for z in (0.0, push))
    error = np.array([push - surprised.mean[0, 0, 0], 2.0 * push / T - surprised.mean[0, 0, 1]])
    added = surprised.covariance[0, 0] - quiet.covariance[0, 0]
    share = (push**2 - S) / push**2
    assert_allclose(added, share * np.outer(error, error), rtol=1e-5)


def test_lag_is_not_seen_in_the_noise_of_a_plot(one_axis) -> None:
    """Below the bound, and with `recursion` always, nothing is added."""
    for estimator, sigmas in ((AlphaBeta(ALPHA, 1), 2.0), (AlphaBeta(ALPHA, 1, 'recursion'), 9.0)):
        mixture = one_axis.start(estimator)
        for _ in range(40):
            mixture = one_axis.look(estimator, mixture, 0.0)
        calm, other = (one_axis.look(estimator, mixture, z) for z in (0.0, sigmas * SD))
        assert_allclose(calm.covariance, other.covariance, rtol=1e-12)


@pytest.mark.parametrize('moved', [50.0, 300.0])
def test_range_rate_of_an_acceleration_is_as_likely_as_its_place(moved: float) -> None:
    """After a T^2 / 2 of position and a T of velocity the distance is at most doubled."""
    estimator = AlphaBeta(ALPHA, 1)
    mixture = estimator.start(np.zeros((1, 2)), np.diag([SD**2, (SD / T) ** 2])[None])
    for _ in range(20):
        mixture = seen(estimator, mixture, 0.0, 0.0)[0]
    _, far = seen(estimator, mixture, moved, 2.0 * moved / T)
    _, place = seen(estimator, mixture, moved, np.nan)
    assert place.distance[0, 0] > 0.0
    assert far.distance[0, 0] <= 2.0 * place.distance[0, 0]


def seen(estimator, mixture, position: float, rate: float):
    """Predict, compare and update one track on one axis with a plot that has a range rate."""
    row, sure = np.zeros(1, np.int64), Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    mixture = estimator.predict(mixture, np.array([T]))
    plot = without_absent(
        np.array([[position, rate]]), np.eye(2)[None], np.diag([SD**2, 2.0**2])[None]
    )
    innovations = estimator.innovate(mixture, row, plot)
    return estimator.update(mixture, row, innovations, sure), innovations
