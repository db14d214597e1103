# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters of a radar tracker become filters and rules?"""

from __future__ import annotations

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.planes import build_planes
from radar_tracker.sensor import Radar
from tracking_core.association import ASSOCIATORS, DECIDING
from tracking_core.composition import Setup
from tracking_core.lifecycle import Lifecycle, LIFECYCLES
from tracking_core.unresolved.resolution import Resolution

__all__ = ['build_planes', 'build_setup']

_SECONDS_PER_HOUR = 3600.0
_START_SHARE = 0.5  # a new track may be this much less likely than one that is dropped


def build_setup(config: RadarTrackerConfig, radar: Radar) -> Setup:
    """Return sensor, filters and rules for these parameters."""
    return Setup(
        sensor=radar,
        planes=build_planes(config, radar.dimensions),
        associate=ASSOCIATORS[config.association],
        is_soft=config.association not in DECIDING,
        lifecycle=_lifecycle(config),
        initiation=config.initiation,
        gate_probability=config.gate.probability,
        clutter_density=config.clutter_density,
        new_contacts=config.existence.new_contacts / _SECONDS_PER_HOUR,
        least_existence=_START_SHARE * config.existence.drop,
        merge=config.merge,
        max_tracks=config.max_tracks,
        longest_pause=config.longest_pause,
        resolution=_resolution(config, radar),
    )


def _resolution(config: RadarTrackerConfig, radar: Radar) -> Resolution | None:
    if config.sensor.range_resolution == 0.0:
        return None
    return Resolution(radar, **vars(config.unresolved))


def _lifecycle(config: RadarTrackerConfig) -> Lifecycle:
    rules = {'existence': config.existence, 'm_of_n': config.m_of_n}
    lifecycle: Lifecycle = LIFECYCLES[config.lifecycle](rules[config.lifecycle])
    return lifecycle
