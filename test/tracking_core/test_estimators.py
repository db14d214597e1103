# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What holds for every estimator of the menu."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from tracking_core.batches import Association, Measurement, Mixture
from tracking_core.config import with_values
from tracking_core.estimators import Estimator, ESTIMATORS, ImmAlphaBeta, MarkovJump
from tracking_core.mode_chain import ModeChain
from tracking_core.rows import take

TRACKS, LOOKS = 6, 12
every_estimator = pytest.mark.parametrize('name', ESTIMATORS)
# The others have one filter, and the first of their two gains is the quiet one.
every_mixture = pytest.mark.parametrize(
    'name', ['markov_jump', 'markov_jump_joint', 'imm_alpha_beta']
)


def make(name: str) -> Estimator:
    """Return the horizontal estimator, as a node makes it."""
    modes = {'acceleration_sd': (1.0, 12.0), 'sojourn_time': (80.0, 30.0), 'turn_rate': (0.0, 0.0)}
    values = {f'motion.horizontal.{key}': list(value) for key, value in modes.items()}
    config = with_values(RadarTrackerConfig(), {'estimator': name, **values})
    return build_planes(config, 2)[0].estimator


def with_modes_swapped(estimator: MarkovJump | ImmAlphaBeta) -> Estimator:
    """Return the same with its modes the other way round."""
    if isinstance(estimator, ImmAlphaBeta):
        return replace(estimator, alpha=estimator.alpha[::-1])
    chain = ModeChain(estimator.chain.sojourn_time[::-1])
    return replace(estimator, motions=estimator.motions[::-1], chain=chain)


def scene(seed: int = 3):
    """Make starts of some tracks, times and plots of their looks, one plot in three missing."""
    rng = np.random.default_rng(seed)
    mean = rng.normal(0.0, [5e3, 80.0, 5e3, 80.0], (TRACKS, 4))
    R = np.diag([900.0, 400.0]) + 100.0
    covariance = np.zeros((TRACKS, 4, 4))
    covariance[:, 0::2, 0::2] = R
    covariance[:, 1::2, 1::2] = R / 9.0
    covariance[:, 0::2, 1::2] = covariance[:, 1::2, 0::2] = R / 5.0
    dt = rng.uniform(2.0, 8.0, (LOOKS, TRACKS))
    time = np.cumsum(dt, axis=0)[..., None]
    path = mean[:, 0::2] + mean[:, 1::2] * time + rng.normal(0.0, 1.0, (TRACKS, 2)) * time**2
    z = path + rng.normal(0.0, 25.0, path.shape)
    seen = rng.random((LOOKS, TRACKS)) < 2.0 / 3.0
    return mean, covariance, dt, z, seen, np.broadcast_to(R, (LOOKS, TRACKS, 2, 2))


def follow(estimator: Estimator, mean, covariance, dt, z, seen, R) -> Mixture:
    """Run the estimator over the scene."""
    mixture, T = estimator.start(mean, covariance), len(mean)
    H = np.zeros((2, 4))
    H[[0, 1], [0, 2]] = 1.0
    for k in range(LOOKS):
        mixture = estimator.predict(mixture, dt[k])
        track = np.flatnonzero(seen[k])
        plots = Measurement(
            z[k, track], np.broadcast_to(H, (len(track), 2, 4)), R[k, track],
            np.zeros(len(track), np.int64),
        )  # fmt: skip
        innovations = estimator.innovate(mixture, track, plots)
        shared = Association(np.full(len(track), 0.9), 1.0 - 0.9 * seen[k], np.zeros(T, bool))
        mixture = estimator.update(mixture, track, innovations, shared)
    return mixture


def assert_same(first: Mixture, second: Mixture) -> None:
    """Equal moments and mode probabilities, to rounding."""
    for one, other in zip(first.moments(), second.moments(), strict=True):
        assert_allclose(one, other, rtol=1e-8, atol=1e-6)
    assert_allclose(first.mode_probability, second.mode_probability, atol=1e-9)


@every_estimator
def test_estimator_treats_a_batch_as_its_members(name: str) -> None:
    """Six tracks together are the same as six tracks one by one."""
    mean, covariance, dt, z, seen, R = scene()
    together = follow(make(name), mean, covariance, dt, z, seen, R)
    for t in range(TRACKS):
        at = slice(t, t + 1)
        alone = follow(
            make(name), mean[at], covariance[at], dt[:, at], z[:, at], seen[:, at], R[:, at]
        )
        assert_same(alone, take(together, at))


@every_estimator
def test_estimator_turns_with_the_world(name: str) -> None:
    """Rotating starts and plots rotates the answer."""
    mean, covariance, dt, z, seen, R = scene()
    c, s = np.cos(0.8), np.sin(0.8)
    turn = np.array([[c, -s], [s, c]])
    whole = np.kron(turn, np.eye(2))
    upright = follow(make(name), mean, covariance, dt, z, seen, R)
    turned = follow(
        make(name), mean @ whole.T, whole @ covariance @ whole.T, dt, z @ turn.T, seen,
        turn @ R @ turn.T,
    )  # fmt: skip
    m, P = upright.moments()
    assert_allclose(turned.moments()[0], m @ whole.T, rtol=1e-8, atol=1e-6)
    assert_allclose(turned.moments()[1], whole @ P @ whole.T, rtol=1e-7, atol=1e-6)
    assert_allclose(turned.mode_probability, upright.mode_probability, atol=1e-9)


@every_mixture
def test_estimator_does_not_mind_the_order_of_modes(name: str) -> None:
    """Swapping the modes swaps their probabilities and nothing else."""
    both = make(name), with_modes_swapped(make(name))
    ours, swapped = (follow(estimator, *scene()) for estimator in both)
    assert np.ptp(ours.mode_probability) > 0.1
    assert_same(
        ours, Mixture(swapped.mean[:, ::-1], swapped.covariance[:, ::-1],
                      swapped.mode_probability[:, ::-1], swapped.memory),
    )  # fmt: skip


@every_estimator
def test_estimator_stays_sound(name: str) -> None:
    """Probabilities sum to 1, covariances are symmetric and positive definite."""
    after = follow(make(name), *scene())
    assert_allclose(after.mode_probability.sum(axis=1), 1.0, atol=1e-12)
    assert_allclose(after.covariance, np.swapaxes(after.covariance, -1, -2), rtol=1e-12)
    assert (np.linalg.eigvalsh(after.covariance) > 0.0).all()


@every_estimator
def test_estimator_takes_empty_batches(name: str) -> None:
    """No tracks, and tracks without plots."""
    mean, covariance, dt, z, seen, R = scene()
    nobody = follow(
        make(name), mean[:0], covariance[:0], dt[:, :0], z[:, :0], seen[:, :0], R[:, :0]
    )
    assert nobody.mean.shape[0] == 0
    unseen = follow(make(name), mean, covariance, dt, z, np.zeros_like(seen), R)
    assert np.isfinite(unseen.mean).all()


def test_markov_jump_is_consistent_on_its_own_model() -> None:
    """NEES per dimension within 0.9 to 1.1 when contacts move as the default modes say."""
    rng, runs, dt = np.random.default_rng(8), 1500, 5.0
    estimator = make('markov_jump')
    R, x = 900.0 * np.eye(2), np.zeros((runs, 4))
    start = np.tile(np.kron(np.diag([900.0, 900.0]), np.diag([1.0, 0.1])), (runs, 1, 1))
    start += np.tile(np.diag([0.0, 100.0, 0.0, 100.0]), (runs, 1, 1))
    x = rng.multivariate_normal(np.zeros(4), start[0], runs)
    mixture = estimator.start(np.zeros((runs, 4)), start)
    mode = (rng.random(runs) < estimator.chain.stationary[1]).astype(int)
    Pi = estimator.chain.transition_probability(np.array([dt]))[0]
    H = np.broadcast_to(np.eye(4)[[0, 2]], (runs, 2, 4))
    sure = Association(np.ones(runs), np.zeros(runs), np.zeros(runs, bool))
    for _ in range(15):
        mode = (rng.random(runs) < Pi[mode, 1]).astype(int)
        push = rng.standard_normal((runs, 2)) * np.array([1.0, 12.0])[mode][:, None]
        x[:, 0::2] += dt * x[:, 1::2] + 0.5 * dt**2 * push
        x[:, 1::2] += dt * push
        z = x[:, 0::2] + rng.standard_normal((runs, 2)) * 30.0
        mixture = estimator.predict(mixture, np.full(runs, dt))
        plots = Measurement(z, H, np.broadcast_to(R, (runs, 2, 2)), np.zeros(runs, np.int64))
        seen = estimator.innovate(mixture, np.arange(runs), plots)
        mixture = estimator.update(mixture, np.arange(runs), seen, sure)
    m, P = mixture.moments()
    nees = ((x - m) * np.linalg.solve(P, (x - m)[..., None])[..., 0]).sum(axis=1) / 4.0
    assert 0.9 < nees.mean() < 1.1
    # The mode probabilities mean what they say: a reliability check in two halves.
    manoeuvres = mixture.mode_probability[:, 1]
    for part in (manoeuvres < 0.5, manoeuvres >= 0.5):
        assert mode[part].mean() == pytest.approx(manoeuvres[part].mean(), abs=0.06)
