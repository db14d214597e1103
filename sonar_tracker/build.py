# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters of a sonar tracker become filters and rules?"""

from __future__ import annotations

from dataclasses import replace

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.marked import Marked
from sonar_tracker.range_prior import RANGE_PRIORS
from sonar_tracker.sensor import Sonar
from tracking_core.assembly import assemble
from tracking_core.composition import Plane, Setup
from tracking_core.estimators import (
    DecoupledKalman,
    Estimator,
    FiniteMemory,
    MarkovJump,
    ModifiedPolar,
)
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import RandomWalk

_LOOKS_ASIDE = 15  # in a blind sector: own ship turns, and it passes


def build_setup(config: SonarTrackerConfig, sonar: Sonar) -> Setup:
    """Return sensor, filters and rules for these parameters."""
    start = config.initiation
    initiation = InitiationConfig(
        method=start.method, speed_max=start.rate_max, speed_sd=start.rate_sd,
        memory=start.memory, faint_starts=start.faint_starts,
    )  # fmt: skip
    planes = (Plane(_with_marks(build_estimator(config), config), (0,)),)
    setup = assemble(config, sonar, planes, initiation, config.sensor.bearing_resolution)
    return replace(setup, looks_outside=_LOOKS_ASIDE)


def build_estimator(config: SonarTrackerConfig) -> Estimator:
    """Return the filter of the bearing."""
    motion = config.motion
    chain = ModeChain(motion.sojourn_time)
    walks = tuple(
        RandomWalk(*noise) for noise in zip(motion.bearing_noise, motion.rate_noise, strict=True)
    )
    if config.estimator == 'kalman':
        return MarkovJump(walks, chain)
    if config.estimator == 'kalman_decoupled':
        return DecoupledKalman(walks[0])
    if config.estimator == 'finite_memory':
        return FiniteMemory(motion.memory)
    mean, sd = RANGE_PRIORS[motion.range_prior](motion.range_min, motion.range_max)
    return ModifiedPolar(
        bearing_noise=motion.bearing_noise,
        rate_noise=motion.rate_noise,
        chain=chain,
        closing_sd=motion.closing_sd,
        inverse_range=mean,
        inverse_range_sd=sd,
    )


def _with_marks(estimator: Estimator, config: SonarTrackerConfig) -> Estimator:
    return Marked(estimator) if config.ranging.enabled else estimator
