# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters of a sonar tracker become filters and rules?"""

from __future__ import annotations

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.marked import Marked
from sonar_tracker.range_prior import RANGE_PRIORS
from sonar_tracker.sensor import Sonar
from tracking_core.association import ASSOCIATORS, DECIDING
from tracking_core.composition import Plane, Setup
from tracking_core.estimators import (
    DecoupledKalman,
    Estimator,
    FiniteMemory,
    MarkovJump,
    ModifiedPolar,
)
from tracking_core.lifecycle import Lifecycle, LIFECYCLES
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import RandomWalk
from tracking_core.unresolved.resolution import Resolution

_SECONDS_PER_HOUR = 3600.0
_START_SHARE = 0.5  # a new track may be this much less likely than one that is dropped


def build_setup(config: SonarTrackerConfig, sonar: Sonar) -> Setup:
    """Return sensor, filters and rules for these parameters."""
    start = config.initiation
    return Setup(
        sensor=sonar,
        planes=(Plane(_with_marks(build_estimator(config), config), (0,)),),
        associate=ASSOCIATORS[config.association],
        is_soft=config.association not in DECIDING,
        lifecycle=_lifecycle(config),
        initiation=InitiationConfig(
            method=start.method, speed_max=start.rate_max, speed_sd=start.rate_sd,
            memory=start.memory,
        ),
        gate_probability=config.gate.probability,
        clutter_density=config.clutter_density,
        new_contacts=config.existence.new_contacts / _SECONDS_PER_HOUR,
        least_existence=_START_SHARE * config.existence.drop,
        merge=config.merge,
        max_tracks=config.max_tracks,
        longest_pause=config.longest_pause,
        resolution=_resolution(config, sonar),
    )  # fmt: skip


def _resolution(config: SonarTrackerConfig, sonar: Sonar) -> Resolution | None:
    if config.sensor.bearing_resolution == 0.0:
        return None
    rule = config.unresolved
    return Resolution(
        sonar, rule.softness, rule.spread, rule.interference, rule.capture, rule.least_chance
    )


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


def _lifecycle(config: SonarTrackerConfig) -> Lifecycle:
    rules = {
        'existence': config.existence,
        'm_of_n': config.m_of_n,
        'error_ratio': config.error_ratio,
    }
    lifecycle: Lifecycle = LIFECYCLES[config.lifecycle](rules[config.lifecycle])
    return lifecycle
