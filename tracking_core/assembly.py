# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters that all trackers have become filters and rules?"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tracking_core.association import ASSOCIATORS, DECIDING
from tracking_core.composition import Plane, Setup
from tracking_core.lifecycle import Lifecycle, LIFECYCLES
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.unresolved.resolution import Resolution

_SECONDS_PER_HOUR = 3600.0
_START_SHARE = 0.5  # a new track may be this much less likely than one that is dropped


def assemble(
    config: Any,
    sensor: Any,
    planes: tuple[Plane, ...],
    initiation: InitiationConfig,
    resolution: float,
) -> Setup:
    """
    Return sensor, filters and rules of a tracker.

    Parameters
    ----------
    config : RadarTrackerConfig or SonarTrackerConfig
        Of the tracker.
    sensor : Radar or Sonar
        A `Sensor`, and `Resolving` too.
    planes : tuple of Plane
        Its filters.
    initiation : InitiationConfig
        How tracks start, in the coordinates of the plots.
    resolution : float
        Nearer contacts give one plot, 0: never.

    """
    lifecycle: Lifecycle = LIFECYCLES[config.lifecycle](getattr(config, config.lifecycle))
    return Setup(
        sensor=sensor,
        planes=planes,
        associate=ASSOCIATORS[config.association],
        is_soft=config.association not in DECIDING,
        lifecycle=lifecycle,
        initiation=initiation if lifecycle.follows_faint else replace(initiation, faint_starts=0),
        gate_probability=config.gate.probability,
        clutter_density=config.clutter_density,
        new_contacts=config.existence.new_contacts / _SECONDS_PER_HOUR,
        least_existence=_START_SHARE * config.existence.drop,
        merge=config.merge,
        max_tracks=config.max_tracks,
        longest_pause=config.longest_pause,
        resolution=Resolution(sensor, **vars(config.unresolved)) if resolution else None,
    )
