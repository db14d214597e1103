# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters of a radar tracker become filters and rules?"""

from __future__ import annotations

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.motion_config import MotionConfig
from radar_tracker.sensor import Radar
from tracking_core.association import ASSOCIATORS
from tracking_core.composition import Plane, Setup
from tracking_core.estimators import ESTIMATORS
from tracking_core.lifecycle import Lifecycle, LIFECYCLES
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity, CoordinatedTurn, Motion

_SECONDS_PER_HOUR = 3600.0
_SOFT = ('jpda', 'pda')
_START_SHARE = 0.5  # a new track may be this much less likely than one that is dropped


def build_setup(config: RadarTrackerConfig, radar: Radar) -> Setup:
    """Return sensor, filters and rules for these parameters."""
    return Setup(
        sensor=radar,
        planes=build_planes(config, radar.dimensions),
        associate=ASSOCIATORS[config.association],
        is_soft=config.association in _SOFT,
        lifecycle=_lifecycle(config),
        initiation=config.initiation,
        gate_probability=config.gate.probability,
        clutter_density=config.clutter_density,
        new_contacts=config.existence.new_contacts / _SECONDS_PER_HOUR,
        least_existence=_START_SHARE * config.existence.drop,
        merge=config.merge,
        max_tracks=config.max_tracks,
    )


def build_planes(config: RadarTrackerConfig, dimensions: int) -> tuple[Plane, ...]:
    """Return the horizontal plane and, for a 3-D radar, the vertical one [ZHUK09]."""
    estimator = ESTIMATORS[config.estimator]
    level, height = config.motion.horizontal, config.motion.vertical
    horizontal = Plane(
        estimator(_horizontal(config.motion), ModeChain(level.sojourn_time)), (0, 1)
    )
    if dimensions == 2:
        return (horizontal,)
    motions = tuple(ConstantVelocity(sd, axes=1) for sd in height.acceleration_sd)
    return (horizontal, Plane(estimator(motions, ModeChain(height.sojourn_time)), (2,)))


def _horizontal(motion: MotionConfig) -> tuple[Motion, ...]:
    level = motion.horizontal
    return tuple(
        CoordinatedTurn(rate, sd) if rate else ConstantVelocity(sd)
        for rate, sd in zip(level.turn_rate, level.acceleration_sd, strict=True)
    )


def _lifecycle(config: RadarTrackerConfig) -> Lifecycle:
    rules = {'existence': config.existence, 'm_of_n': config.m_of_n}
    lifecycle: Lifecycle = LIFECYCLES[config.lifecycle](rules[config.lifecycle])
    return lifecycle
