# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What holds for every motion model, and for the chain of modes."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest
from scipy.linalg import expm

from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity, CoordinatedTurn, Motion, RandomWalk

EXAMPLES = [
    ConstantVelocity(2.0), ConstantVelocity(0.5, axes=1),
    CoordinatedTurn(0.05, 2.0), CoordinatedTurn(-0.3, 1.0),
    RandomWalk(1e-3, 1e-4),
]  # fmt: skip
every_motion = pytest.mark.parametrize('motion', EXAMPLES, ids=repr)
DT = np.array([0.0, 0.1, 1.0, 7.3, 20.0])
CHAINS = [ModeChain((10.0,)), ModeChain((60.0, 20.0)), ModeChain((60.0, 20.0, 5.0, 300.0))]
every_chain = pytest.mark.parametrize('chain', CHAINS, ids=lambda chain: str(chain.modes))


@every_motion
def test_transition_composes(motion: Motion) -> None:
    """F(a + b) = F(b) F(a), and F(0) = I."""
    F, after = motion.transition(DT), motion.transition(DT + 4.2)
    assert_allclose(after, motion.transition(np.full(len(DT), 4.2)) @ F, rtol=1e-12, atol=1e-12)
    assert_allclose(F[0], np.eye(2 * motion.axes), atol=0.0)


@every_motion
def test_transition_moves_with_the_velocity(motion: Motion) -> None:
    """Over a short time the position changes by velocity times time."""
    rng = np.random.default_rng(1)
    state = rng.normal(0.0, 100.0, 2 * motion.axes)
    moved = motion.transition(np.array([1e-6]))[0] @ state
    assert_allclose((moved - state)[0::2], 1e-6 * state[1::2], rtol=1e-4)


@every_motion
def test_process_noise_is_a_covariance(motion: Motion) -> None:
    """Symmetric, positive semidefinite, growing with time, nothing after no time."""
    Q = motion.process_noise(DT)
    assert Q.shape == (len(DT), 2 * motion.axes, 2 * motion.axes)
    assert_allclose(Q, np.swapaxes(Q, 1, 2), atol=0.0)
    values = np.linalg.eigvalsh(Q)
    assert (values >= -1e-9 * np.abs(values).max()).all()
    assert (np.diff(np.einsum('tnn->tn', Q), axis=0) > 0.0).all()
    assert_allclose(Q[0], 0.0, atol=0.0)


def test_process_noise_is_that_of_a_constant_acceleration() -> None:
    """Q = s^2 [T^4/4, T^3/2; T^3/2, T^2] on each axis."""
    Q = ConstantVelocity(3.0).process_noise(np.array([10.0]))[0]
    block = 9.0 * np.array([[2500.0, 500.0], [500.0, 100.0]])
    assert_allclose(Q, np.kron(np.eye(2), block), rtol=1e-14)


@pytest.mark.parametrize('rate', [0.0, 1e-9, -1e-7])
def test_coordinated_turn_tends_to_constant_velocity(rate: float) -> None:
    """At a vanishing turn rate F is that of straight motion."""
    straight = ConstantVelocity(2.0).transition(DT)
    assert_allclose(CoordinatedTurn(rate, 2.0).transition(DT), straight, atol=1e-4)


def test_coordinated_turn_is_a_circle() -> None:
    """After a full turn all is as before; after a quarter left, north has become west."""
    F = CoordinatedTurn(np.pi / 20.0, 1.0).transition(np.array([40.0, 10.0]))
    assert_allclose(F[0], np.eye(4), atol=1e-9)
    radius = 100.0 / (np.pi / 20.0)
    quarter = F[1] @ np.array([0.0, 0.0, 0.0, 100.0])
    assert_allclose(quarter, [-radius, -100.0, radius, 0.0], atol=1e-9)


def test_coordinated_turn_needs_two_axes() -> None:
    """A turn needs a plane."""
    with pytest.raises(ValueError, match='axes must be 2, got 1'):
        CoordinatedTurn(0.1, 1.0, axes=1)


@every_chain
def test_transition_probability_is_a_chain(chain: ModeChain) -> None:
    """Rows sum to 1, Pi(a) Pi(b) = Pi(a + b), Pi(0) = I."""
    Pi = chain.transition_probability(DT)
    assert Pi.shape == (len(DT), chain.modes, chain.modes)
    assert (Pi >= 0.0).all()
    assert_allclose(Pi.sum(axis=2), 1.0, atol=1e-12)
    assert_allclose(Pi[0], np.eye(chain.modes), atol=1e-12)
    one = chain.transition_probability(np.array([4.2]))
    assert_allclose(chain.transition_probability(DT + 4.2), Pi @ one, atol=1e-12)


@every_chain
def test_transition_probability_is_the_exponential_of_the_rates(chain: ModeChain) -> None:
    """Pi(dt) = exp(Q dt): leave mode i at 1 / sojourn_time[i], to any other one alike."""
    rate = 1.0 / np.array(chain.sojourn_time)
    others = max(chain.modes - 1, 1)
    Q = np.repeat(rate[:, None] / others, chain.modes, axis=1)
    np.fill_diagonal(Q, -rate if chain.modes > 1 else 0.0)
    for dt, Pi in zip(DT, chain.transition_probability(DT), strict=True):
        assert_allclose(Pi, expm(Q * dt), atol=1e-12)


@every_chain
def test_stationary_does_not_change(chain: ModeChain) -> None:
    """It is its own successor, and where the chain ends up."""
    Pi = chain.transition_probability(np.array([3.0, 1e6]))
    assert_allclose(chain.stationary @ Pi[0], chain.stationary, atol=1e-12)
    assert_allclose(Pi[1], np.tile(chain.stationary, (chain.modes, 1)), atol=1e-9)


@pytest.mark.parametrize(('probability', 'modes'), [(0.9, 2), (0.95, 2), (0.8, 3), (0.5, 5)])
def test_staying_gives_the_probability_asked_for(probability: float, modes: int) -> None:
    """Pi(dt) has the probability on its diagonal and equal shares elsewhere."""
    chain = ModeChain.staying(probability, 10.0, modes)
    expected = np.full((modes, modes), (1.0 - probability) / (modes - 1))
    np.fill_diagonal(expected, probability)
    assert_allclose(chain.transition_probability(np.array([10.0]))[0], expected, atol=1e-12)


@pytest.mark.parametrize(('probability', 'modes'), [(0.5, 2), (1.0, 2), (0.33, 3)])
def test_staying_refuses_what_no_chain_can_do(probability: float, modes: int) -> None:
    """To stay less likely than by chance is not a matter of sojourn times."""
    with pytest.raises(ValueError, match='staying probability must be in'):
        ModeChain.staying(probability, 10.0, modes)
