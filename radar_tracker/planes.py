# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which estimator follows which coordinates of a contact, by the parameters?"""

from __future__ import annotations

from collections.abc import Callable

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.estimator_config import AlphaBetaConfig
from tracking_core.composition import Plane
from tracking_core.estimators import (
    AdaptiveAlphaBeta,
    AlphaBeta,
    Estimator,
    FuzzyAlphaBeta,
    ImmAlphaBeta,
    MarkovJump,
    MarkovJumpJoint,
    TwoPoint,
)
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity, CoordinatedTurn

_GROUND, _HEIGHT = (0, 1), (2,)


def build_planes(config: RadarTrackerConfig, dimensions: int) -> tuple[Plane, ...]:
    """Return the horizontal plane and, for a 3-D radar, the vertical one, or both as one."""
    if config.estimator in _ALPHA_BETA:
        make = _ALPHA_BETA[config.estimator]
        ground = Plane(make(config.alpha_beta, len(_GROUND)), _GROUND)
        height = Plane(make(config.alpha_beta, len(_HEIGHT)), _HEIGHT)
        return (ground,) if dimensions == 2 else (ground, height)
    horizontal = _horizontal(config)
    if dimensions == 2:
        return (Plane(horizontal, _GROUND),)
    vertical = _vertical(config)
    if config.estimator == 'markov_jump_joint':
        return (Plane(MarkovJumpJoint(horizontal, vertical), _GROUND + _HEIGHT),)
    return Plane(horizontal, _GROUND), Plane(vertical, _HEIGHT)


def _horizontal(config: RadarTrackerConfig) -> MarkovJump:
    horizontal = config.motion.horizontal
    motions = tuple(
        CoordinatedTurn(rate, sd) if rate else ConstantVelocity(sd)
        for rate, sd in zip(horizontal.turn_rate, horizontal.acceleration_sd, strict=True)
    )
    return MarkovJump(motions, ModeChain(horizontal.sojourn_time))


def _vertical(config: RadarTrackerConfig) -> MarkovJump:
    vertical = config.motion.vertical
    motions = tuple(ConstantVelocity(sd, axes=1) for sd in vertical.acceleration_sd)
    return MarkovJump(motions, ModeChain(vertical.sojourn_time))


def _imm(c: AlphaBetaConfig, axes: int) -> Estimator:
    return ImmAlphaBeta(c.alpha, axes, c.covariance, c.stay_probability)


def _adaptive(c: AlphaBetaConfig, axes: int) -> Estimator:
    a = c.adaptive
    return AdaptiveAlphaBeta(
        c.alpha, axes, c.covariance, a.false_alarm, a.ramp, a.restartable, c.stay_probability
    )


def _fuzzy(c: AlphaBetaConfig, axes: int) -> Estimator:
    return FuzzyAlphaBeta(
        c.alpha, axes, c.covariance, c.fuzzy.false_alarm, c.fuzzy.table(), c.stay_probability
    )


def _two_point(c: AlphaBetaConfig, axes: int) -> Estimator:
    return TwoPoint(c.alpha, axes, c.covariance, c.fuzzy.false_alarm, c.stay_probability)


def _plain(c: AlphaBetaConfig, axes: int) -> Estimator:
    return AlphaBeta(c.alpha[0], axes, c.covariance)


_ALPHA_BETA: dict[str, Callable[[AlphaBetaConfig, int], Estimator]] = {
    'imm_alpha_beta': _imm,
    'adaptive_alpha_beta': _adaptive,
    'fuzzy_alpha_beta': _fuzzy,
    'two_point': _two_point,
    'alpha_beta': _plain,
}
