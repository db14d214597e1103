# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The optimal structure of [ZHUK09]: one state, modes in pairs."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from studies.passes import Measured, run
from studies.z_scenes import joint_figures, paper_filters, position_errors, Scene, Z_0, Z_NEAR
from tracking_core.batches import Association, Measurement
from tracking_core.composition import Plane
from tracking_core.config import with_values
from tracking_core.estimators import MarkovJump, MarkovJumpJoint
from tracking_core.estimators.markov_jump_joint import ProductChain, StackedMotion
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity

LEVEL = MarkovJump((ConstantVelocity(1.0), ConstantVelocity(20.0)), ModeChain((80.0, 30.0)))
HEIGHT = MarkovJump(
    tuple(ConstantVelocity(sd, axes=1) for sd in (0.5, 3.0, 15.0)),
    ModeChain((50.0, 40.0, 20.0)),
    (0.5, 0.3, 0.2),
)


def plots(runs: int = 5, contacts: int = 30) -> Measured:
    """Return plots of a climbing turn, R without covariance between the planes."""
    rng = np.random.default_rng(4)
    time = 5.0 * np.arange(contacts)[:, None]
    path = np.stack([200.0 * time, 2.0 * time**2, 0.05 * time**2], axis=2)
    R = np.zeros((contacts, runs, 3, 3))
    R[..., :2, :2], R[..., 2, 2] = [[900.0, 300.0], [300.0, 400.0]], 2500.0
    noise = rng.multivariate_normal(np.zeros(3), R[0, 0], (contacts, runs))
    return Measured(path + noise, R)


def test_joint_equals_decomposed_when_planes_do_not_touch() -> None:
    """Block-diagonal R: mean, covariance and mode probabilities to 1e-9."""
    joint = run([Plane(MarkovJumpJoint(LEVEL, HEIGHT), (0, 1, 2))], plots(), 5.0)[0]
    apart = run([Plane(LEVEL, (0, 1)), Plane(HEIGHT, (2,))], plots(), 5.0)
    for both, level, height in zip(joint, *apart, strict=True):
        mean, P = both.updated.moments()
        for step, at in ((level, slice(0, 4)), (height, slice(4, 6))):
            m, part = step.updated.moments()
            assert_allclose(mean[:, at], m, rtol=1e-9, atol=1e-7)
            assert_allclose(P[:, at, at], part, rtol=1e-8, atol=1e-7)
        probability = both.updated.mode_probability.reshape(-1, 2, 3)
        assert_allclose(probability.sum(axis=2), level.updated.mode_probability, atol=1e-9)
        assert_allclose(probability.sum(axis=1), height.updated.mode_probability, atol=1e-9)


def test_transition_probability_is_the_kronecker_product() -> None:
    """The vertical mode counts fastest; rows sum to 1."""
    dt = np.array([0.5, 7.0])
    chain = ProductChain(LEVEL.chain, HEIGHT.chain)
    Pi = chain.transition_probability(dt)
    for t in range(2):
        one, other = (
            c.transition_probability(dt[t : t + 1])[0] for c in (LEVEL.chain, HEIGHT.chain)
        )
        assert_allclose(Pi[t], np.kron(one, other))
    assert_allclose(Pi.sum(axis=2), 1.0)
    assert_allclose(chain.stationary @ Pi[0], chain.stationary, atol=1e-12)


def test_stacked_motion_has_both_as_blocks() -> None:
    """F and Q of the pair, nothing between."""
    motion, dt = StackedMotion(LEVEL.motions[1], HEIGHT.motions[2]), np.array([4.0])
    assert motion.axes == 3
    for joint, parts in (
        (motion.transition(dt), [m.transition(dt) for m in (motion.first, motion.second)]),
        (motion.process_noise(dt), [m.process_noise(dt) for m in (motion.first, motion.second)]),
    ):
        assert_allclose(joint[0, :4, :4], parts[0][0])
        assert_allclose(joint[0, 4:, 4:], parts[1][0])
        assert not joint[0, :4, 4:].any()


def test_joint_takes_a_range_rate_as_fourth_component() -> None:
    """Position and range rate at once: the same as one after the other."""
    estimator = MarkovJumpJoint(*paper_filters(5.0))
    rng = np.random.default_rng(3)
    root = rng.normal(0.0, 10.0, (1, 6, 6))
    mixture = estimator.start(rng.normal(0.0, 10.0, (1, 6)), root @ np.swapaxes(root, 1, 2))
    H = np.zeros((1, 4, 6))
    H[0, [0, 1, 2], [0, 2, 4]] = 1.0
    H[0, 3, 1::2] = [0.6, 0.64, 0.48]
    z, R = rng.normal(0.0, 10.0, (1, 4)), np.diag([25.0, 30.0, 35.0, 4.0])[None]
    sure, row = Association(np.ones(1), np.zeros(1), np.zeros(1, bool)), np.zeros(1, np.int64)

    def after(mixture, at):
        plot = Measurement(z[:, at], H[:, at], R[:, at, at], row)
        return estimator.update(mixture, row, estimator.innovate(mixture, row, plot), sure)

    once, twice = after(mixture, slice(0, 4)), after(after(mixture, slice(0, 3)), slice(3, 4))
    assert_allclose(once.mean, twice.mean, rtol=1e-8)
    assert_allclose(once.mode_probability, twice.mode_probability, rtol=1e-8)


def test_radar_has_one_plane_for_joint_and_the_default_in_two_dimensions() -> None:
    """3-D: one plane of three axes with all pairs of modes; 2-D: markov_jump."""
    config = with_values(RadarTrackerConfig(), {'estimator': 'markov_jump_joint'})
    (plane,) = build_planes(config, 3)
    assert plane.coordinates == (0, 1, 2)
    assert plane.estimator.axes == 3
    assert plane.estimator.start(np.zeros((1, 6)), np.eye(6)[None]).mean.shape == (1, 4, 6)
    assert build_planes(config, 2) == build_planes(RadarTrackerConfig(), 2)


@pytest.mark.parametrize(
    ('scene', 'span', 'ratio', 'tolerance'),
    [
        (Z_0, 'manoeuvre', 1.0, 0.003),
        (Z_0, 'quiet', 1.0, 0.003),
        (Z_NEAR, 'manoeuvre', 0.926, 0.02),
        (Z_NEAR, 'quiet', 0.947, 0.02),
    ],
)
def test_joint_gains_near_and_high_only(
    scene: Scene, span: str, ratio: float, tolerance: float
) -> None:
    """Position RMSE over that of the decomposed filter, 500 runs."""
    values = joint_figures(position_errors(scene, 500), scene, np.arange(500))
    assert values[f'joint {span}'] == pytest.approx(ratio, abs=tolerance)
