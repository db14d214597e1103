# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The filters of bearings: against textbook formulas, exact motions and numbers in print."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.batches import Association, Measurement, Mixture
from tracking_core.estimators import (
    DecoupledKalman,
    Estimator,
    FiniteMemory,
    MarkovJump,
    ModifiedPolar,
)
from tracking_core.estimators.modified_polar import go_straight, step_aside
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import RandomWalk
from tracking_core.rows import take

WALK = RandomWalk(1e-4, 1e-6)
POLAR = ModifiedPolar((1e-5,), (1e-7,), ModeChain((600.0,)), 1e-3, 2e-4, 1e-4)
TWO_MODES = ModifiedPolar((1e-5, 1e-5), (1e-7, 1e-5), ModeChain((600.0, 60.0)), 1e-3, 2e-4, 1e-4)
EXAMPLES: dict[str, Estimator] = {
    'kalman': MarkovJump((WALK,), ModeChain((600.0,))),
    'kalman, two modes': MarkovJump((WALK, RandomWalk(1e-3, 1e-4)), ModeChain((600.0, 60.0))),
    'kalman_decoupled': DecoupledKalman(WALK),
    'finite_memory': FiniteMemory(8),
    'modified_polar': POLAR,
    'modified_polar, two modes': TWO_MODES,
}
every_estimator = pytest.mark.parametrize('estimator', EXAMPLES.values(), ids=EXAMPLES)
TRACKS = 5
START = np.array([[4e-6, 2e-6], [2e-6, 2e-6]])


def start(estimator: Estimator, count: int = TRACKS, seed: int = 1) -> Mixture:
    """Tracks at random bearings and rates, from two marks 2 s apart."""
    mean = np.random.default_rng(seed).normal(0.0, [1.0, 1e-3], (count, 2))
    return estimator.start(mean, np.tile(START, (count, 1, 1)))


def look(estimator, mixture, dt, z, sd=2e-3, chance=None) -> Mixture:
    """Predict over dt [s] and update with one mark z (T,) [rad] for every track."""
    T = len(mixture.mean)
    mixture = estimator.predict(mixture, np.broadcast_to(dt, T).astype(float))
    H = np.zeros((T, 1, 2))
    H[:, 0, 0] = 1.0
    marks = Measurement(z[:, None], H, np.full((T, 1, 1), sd**2), np.zeros(T, np.int64))
    track = np.arange(T)
    chance = np.ones(T) if chance is None else chance
    shared = Association(chance, 1.0 - chance, np.zeros(T, bool))
    return estimator.update(mixture, track, estimator.innovate(mixture, track, marks), shared)


def follow(estimator, mixture, looks=20, seed=2) -> Mixture:
    """Run over noisy marks of steady bearings, some of them missed."""
    rng = np.random.default_rng(seed)
    line = mixture.moments()[0]
    time = np.zeros(len(line))
    noise, chances = rng.normal(0.0, 2e-3, (looks, 50)), rng.random((looks, 50))
    for k in range(looks):
        time = time + 2.0 + 0.1 * k
        z = line[:, 0] + line[:, 1] * time + noise[k, : len(line)]
        chance = np.where(chances[k, : len(line)] < 0.3, 0.0, 0.95)
        mixture = look(estimator, mixture, 2.0 + 0.1 * k, z, chance=chance)
    return mixture


@every_estimator
def test_estimator_stays_sound(estimator: Estimator) -> None:
    """Finite, symmetric, positive definite, probabilities that sum to 1, sharper than before."""
    after = follow(estimator, start(estimator))
    assert np.isfinite(after.mean).all()
    assert_allclose(after.covariance, np.swapaxes(after.covariance, -1, -2), rtol=1e-9)
    assert (np.linalg.eigvalsh(after.covariance) > 0.0).all()
    assert_allclose(after.mode_probability.sum(axis=1), 1.0, atol=1e-12)
    assert np.median(after.moments()[1][:, 0, 0]) < 4e-6


@every_estimator
def test_estimator_treats_a_batch_as_its_members(estimator: Estimator) -> None:
    """Five tracks together are the same as the first alone; no tracks are legal."""
    together = follow(estimator, start(estimator))
    alone = follow(estimator, take(start(estimator), slice(0, 1)))
    assert_allclose(alone.mean[0], together.mean[0], rtol=1e-9)
    assert_allclose(alone.covariance[0], together.covariance[0], rtol=1e-7)
    assert len(follow(estimator, start(estimator, 0)).mean) == 0


@every_estimator
def test_estimator_starts_with_what_it_is_given(estimator: Estimator) -> None:
    """Bearing and rate after the start are those of the two marks, covariance included."""
    mean = np.array([[0.3, 1e-3], [-3.0, 0.0]])
    begun = estimator.start(mean, np.tile(START, (2, 1, 1)))
    m, P = begun.moments()
    assert_allclose(m[:, :2], mean, atol=1e-12)
    diagonal = START * np.eye(2) if isinstance(estimator, DecoupledKalman) else START
    assert_allclose(P[:, :2, :2], np.tile(diagonal, (2, 1, 1)), rtol=1e-9, atol=1e-18)


def test_decoupled_kalman_is_the_printed_one() -> None:
    """(6) to (9): M - M^2 / S with M = s_a^2 + s_V^2 dt^2 + q, gains from the same."""
    a, V, va, vV, dt, R = 0.2, 1e-3, 3e-6, 1e-8, 2.0, 4e-6
    estimator = DecoupledKalman(WALK)
    begun = estimator.start(np.array([[a, V]]), np.diag([va, vV])[None])
    q = WALK.process_noise(np.array([dt]))[0]
    z = np.array([0.21])
    after = look(estimator, begun, dt, z, sd=np.sqrt(R))
    M = va + vV * dt**2 + q[0, 0]
    S = M + R
    nu = z[0] - (a + V * dt)
    cross = vV * dt + q[0, 1]
    assert_allclose(after.mean[0, 0], [a + V * dt + M / S * nu, V + cross / S * nu], rtol=1e-12)
    expected = np.diag([M - M**2 / S, vV + q[1, 1] - cross**2 / S])
    assert_allclose(after.covariance[0, 0], expected, rtol=1e-9, atol=1e-25)


def test_finite_memory_is_exact_on_an_exact_line() -> None:
    """Marks without noise on a line give the line (1e-9)."""
    estimator = FiniteMemory(15)
    mixture = estimator.start(np.array([[1.0, 2e-3]]), START[None])
    for k in range(1, 40):
        mixture = look(estimator, mixture, 2.0, np.array([1.0 + 4e-3 * k]), sd=1e-3)
        assert_allclose(mixture.mean[0, 0], [1.0 + 4e-3 * k, 2e-3], rtol=1e-9)


def test_finite_memory_has_the_printed_errors() -> None:
    """K' = 15, sd 0.05 deg, 2 s: s_V 1.356e-3 deg/s (2 %), prediction sd 0.0262 deg (0.0003)."""
    estimator = FiniteMemory(15)
    mixture = estimator.start(np.zeros((1, 2)), START[None])
    for _ in range(20):
        mixture = look(estimator, mixture, 2.0, np.zeros(1), sd=np.radians(0.05))
    sd = np.degrees(np.sqrt(np.diag(mixture.covariance[0, 0])))
    assert sd[1] == pytest.approx(1.356e-3, rel=0.02)
    ahead = estimator.predict(mixture, np.array([2.0]))
    prediction = np.degrees(np.sqrt(ahead.covariance[0, 0, 0, 0]))
    assert prediction == pytest.approx(0.0262, abs=3e-4)


def test_finite_memory_is_weighted_least_squares() -> None:
    """Against numpy's fit, with marks of unequal weight and times."""
    rng, estimator = np.random.default_rng(4), FiniteMemory(6)
    mixture = estimator.start(np.array([[0.5, 0.0]]), START[None])
    steps = rng.uniform(1.0, 4.0, 12)
    z, sd = 0.5 + rng.normal(0.0, 2e-3, 12), rng.uniform(1e-3, 3e-3, 12)
    for dt, mark, noise in zip(steps, z, sd, strict=True):
        mixture = look(estimator, mixture, dt, np.array([mark]), sd=noise)
    age = np.cumsum(steps)[-1] - np.cumsum(steps)
    slope, now = np.polyfit(-age[-7:], z[-7:], 1, w=1.0 / sd[-7:])
    assert_allclose(mixture.mean[0, 0], [now, slope], rtol=1e-9)


def seen_from(own, own_velocity, contact, velocity) -> np.ndarray:
    """Return the modified polar state of a contact, from Cartesian ones (..., 2)."""
    line, drift = contact - own, velocity - own_velocity
    square = (line**2).sum(axis=-1)
    across = line[..., 0] * drift[..., 1] - line[..., 1] * drift[..., 0]
    return np.stack([
        np.arctan2(line[..., 1], line[..., 0]), across / square,
        (line * drift).sum(axis=-1) / square, 1.0 / np.sqrt(square),
    ], axis=-1)  # fmt: skip


def scene(count: int = 40):
    """Positions and velocities of own ship and of contacts."""
    rng = np.random.default_rng(6)
    return (rng.normal(0.0, 50.0, (count, 2)), rng.normal(0.0, 4.0, (count, 2)),
            rng.normal(0.0, 4000.0, (count, 2)), rng.normal(0.0, 6.0, (count, 2)))  # fmt: skip


def test_go_straight_is_exact() -> None:
    """Straight relative motion over ten minutes, to rounding."""
    own, own_velocity, contact, velocity = scene()
    after, _ = go_straight(seen_from(own, own_velocity, contact, velocity), np.full(40, 600.0))
    expected = seen_from(own + 600.0 * own_velocity, own_velocity, contact + 600.0 * velocity,
                         velocity)  # fmt: skip
    apart = after - expected
    apart[:, 0] = np.angle(np.exp(1j * apart[:, 0]))
    assert_allclose(apart, 0.0, atol=1e-9)


def test_step_aside_is_exact() -> None:
    """The same contact from another place and another course of the sensor."""
    own, own_velocity, contact, velocity = scene()
    step = np.random.default_rng(7).normal(0.0, [300.0, 300.0, 5.0, 5.0], (40, 4))
    after, _ = step_aside(seen_from(own, own_velocity, contact, velocity), step)
    expected = seen_from(own + step[:, :2], own_velocity + step[:, 2:], contact, velocity)
    apart = after - expected
    apart[:, 0] = np.angle(np.exp(1j * apart[:, 0]))
    assert_allclose(apart, 0.0, atol=1e-9)


@pytest.mark.parametrize('move', [
    lambda state: go_straight(state, np.full(state.shape[:-1], 40.0)),
    lambda state: step_aside(state, np.broadcast_to([200.0, -90.0, 3.0, 2.0], state.shape)),
], ids=['go_straight', 'step_aside'])  # fmt: skip
def test_jacobians_are_the_derivatives(move) -> None:
    """Against central differences."""
    state = seen_from(*scene())
    _, jacobian = move(state)
    for n, step in enumerate([1e-6, 1e-8, 1e-8, 1e-9]):
        shift = np.zeros(4)
        shift[n] = step
        slope = (move(state + shift)[0] - move(state - shift)[0]) / (2.0 * step)
        assert_allclose(jacobian[..., n], slope, rtol=1e-4, atol=1e-6 * max(1.0, 1e-9 / step))


def test_modified_polar_learns_the_closing_rate_without_a_manoeuvre() -> None:
    """Straight courses: after 20 minutes range rate over range is known, range is not."""
    own_velocity, contact, velocity = (
        np.array([0.0, 2.5]),
        np.array([4455.0, -2270.0]),
        np.array([0.0, 5.0]),
    )
    rng = np.random.default_rng(3)
    time = np.arange(0.0, 1200.0, 2.0)
    true = seen_from(own_velocity * time[:, None], own_velocity,
                     contact + velocity * time[:, None], velocity)  # fmt: skip
    z = true[:, 0] + rng.normal(0.0, np.radians(0.05), len(time))
    mixture = POLAR.start(np.array([[z[0], 0.0]]), np.diag([1e-6, 1e-6])[None])
    for k in range(1, len(time)):
        mixture = look(POLAR, mixture, 2.0, z[k : k + 1], sd=np.radians(0.05))
    m, P = mixture.moments()
    sd = np.sqrt(np.einsum('tnn->tn', P))[0]
    assert np.abs(m[0, :3] - true[-1, :3] < 4.0 * sd[:3]).all()
    assert sd[2] < 0.1 * POLAR.closing_sd
    assert sd[3] > 0.5 * POLAR.inverse_range_sd


def test_modified_polar_learns_the_range_from_a_manoeuvre() -> None:
    """Own ship turns 60 degrees: the range comes out within its stated error, and small."""
    time = np.arange(0.0, 1800.0, 2.0)
    turned = time >= 900.0
    own_velocity = np.where(turned[:, None], [2.2, 1.28], [0.0, 2.57])
    own = np.concatenate([[[0.0, 0.0]], np.cumsum(2.0 * own_velocity[:-1], axis=0)])
    contact = np.array([4455.0, -2270.0]) + np.array([0.0, 5.14]) * time[:, None]
    true = seen_from(own, own_velocity, contact, np.broadcast_to([0.0, 5.14], own.shape))
    sensor = np.concatenate([own, own_velocity], axis=1)
    z = true[:, 0] + np.random.default_rng(3).normal(0.0, np.radians(0.05), len(time))
    mixture = POLAR.start(np.array([[z[0], 0.0]]), np.diag([1e-6, 1e-6])[None])
    mixture = POLAR.move_sensor(mixture, sensor[:1])
    H, sure = np.array([[[1.0, 0.0]]]), Association(np.ones(1), np.zeros(1), np.zeros(1, bool))
    for k in range(1, len(time)):
        mixture = POLAR.predict(mixture, np.full(1, 2.0))
        mixture = POLAR.move_sensor(mixture, sensor[k : k + 1])
        mark = Measurement(z[k].reshape(1, 1), H, np.full((1, 1, 1), np.radians(0.05) ** 2),
                           np.zeros(1, np.int64))  # fmt: skip
        seen = POLAR.innovate(mixture, np.zeros(1, np.int64), mark)
        mixture = POLAR.update(mixture, np.zeros(1, np.int64), seen, sure)
    m, P = mixture.moments()
    sd = np.sqrt(P[0, 3, 3])
    assert sd < 0.1 * m[0, 3]
    assert abs(m[0, 3] - true[-1, 3]) < 4.0 * sd
