# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters that all trackers have become filters and rules?"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from tracking_core.association import ASSOCIATORS, DECIDING, JOINT
from tracking_core.composition import Plane, ResolvingSensor, Setup
from tracking_core.lifecycle import Lifecycle, LIFECYCLES
from tracking_core.lifecycle_config import (
    ExistenceConfig,
    GateConfig,
    InitiationConfig,
    MergeConfig,
    UnresolvedConfig,
)
from tracking_core.unresolved.resolution import Resolution

_SECONDS_PER_HOUR = 3600.0
_START_SHARE = 0.5  # a new track may be this much less likely than one that is dropped


class TrackerConfig(Protocol):
    """Parameters that all trackers have; those of each lifecycle under its name beside them."""

    @property
    def gate(self) -> GateConfig:
        """How far from its prediction a plot may fall."""

    @property
    def existence(self) -> ExistenceConfig:
        """How many new contacts there are, and when a track is dropped."""

    @property
    def merge(self) -> MergeConfig:
        """When two tracks are one contact."""

    @property
    def unresolved(self) -> UnresolvedConfig:
        """What is known of plots of more than one contact."""

    @property
    def association(self) -> str:
        """Name in `ASSOCIATORS`."""

    @property
    def lifecycle(self) -> str:
        """Name in `LIFECYCLES`, and of its own parameters here."""

    @property
    def clutter_density(self) -> float:
        """False plots of one look per unit of plot space; 0: estimated."""

    @property
    def longest_pause(self) -> float:
        """After a longer one tracks end [s]; 0: they go on."""

    @property
    def max_tracks(self) -> int:
        """New tracks are refused beyond."""


def assemble(
    config: TrackerConfig,
    sensor: ResolvingSensor,
    planes: tuple[Plane, ...],
    initiation: InitiationConfig,
    resolution: float,
) -> Setup:
    """
    Return sensor, filters and rules of a tracker.

    Parameters
    ----------
    config : TrackerConfig
        Of the tracker.
    sensor : ResolvingSensor
        What it measures.
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
        initiation=replace(initiation, faint_starts=0) if lifecycle.counts else initiation,
        gate_probability=config.gate.probability,
        clutter_density=config.clutter_density,
        arrival_rate=config.existence.new_contacts / _SECONDS_PER_HOUR,
        least_existence=_START_SHARE * config.existence.drop,
        merge=config.merge,
        max_tracks=config.max_tracks,
        longest_pause=config.longest_pause,
        resolution=Resolution(sensor, **vars(config.unresolved)) if resolution else None,
        has_own_plots=not resolution and config.association in (*JOINT, *DECIDING),
    )
