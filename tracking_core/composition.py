# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is a tracker made of? The parts that do not change from scan to scan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

from tracking_core.association import Associator
from tracking_core.batches import Floats, Mixture
from tracking_core.estimators import Estimator, SeesFromSensor
from tracking_core.lifecycle import Lifecycle
from tracking_core.lifecycle_config import InitiationConfig, MergeConfig
from tracking_core.sensing import Sensor
from tracking_core.several_plots import Extent, ONE_PLOT
from tracking_core.unresolved.resolution import Resolution, Resolving


@dataclass(frozen=True)
class Plane:
    """Coordinates of the plots that one estimator follows, apart from the other planes."""

    estimator: Estimator
    coordinates: tuple[int, ...]  # consecutive

    @cached_property
    def part(self) -> slice:
        """Where the coordinates stand in a plot."""
        return slice(self.coordinates[0], self.coordinates[-1] + 1)

    def start(self, mean: Floats, covariance: Floats, sensor: Floats) -> Mixture:
        """Return new tracks; `sensor` (T, 4) is its x, y, vx, vy at their time [m, m/s]."""
        return self._seen_from(self.estimator.start(mean, covariance), sensor)

    def predict(self, mixture: Mixture, dt: Floats, sensor: Floats) -> Mixture:
        """Return the plane after dt (T,) [s], when the sensor is at x, y, vx, vy (T, 4)."""
        return self._seen_from(self.estimator.predict(mixture, dt), sensor)

    def _seen_from(self, mixture: Mixture, sensor: Floats) -> Mixture:
        return self._moving.move_sensor(mixture, sensor) if self._moving else mixture

    @cached_property
    def _moving(self) -> SeesFromSensor | None:
        return self.estimator if isinstance(self.estimator, SeesFromSensor) else None


class ResolvingSensor(Sensor, Resolving, Protocol):
    """A sensor with all that any rule asks of it."""


@dataclass(frozen=True)
class Setup:
    """Sensor, filters and rules of one tracker."""

    sensor: Sensor
    planes: tuple[Plane, ...]
    associate: Associator
    is_soft: bool  # associate shares a plot among tracks (PDA, JPDA), it does not decide
    lifecycle: Lifecycle
    initiation: InitiationConfig
    gate_probability: float  # P_G
    clutter_density: float  # per unit of plot space and look; 0: estimated
    arrival_rate: float  # of new contacts, expected in the whole coverage [1/s]
    least_existence: float  # of a new track
    merge: MergeConfig
    max_tracks: int
    longest_pause: float  # a track that nobody looked at for longer ends [s]; 0: none does
    looks_outside: int = 5  # the coverage since its last plot, after which a track has left
    resolution: Resolution | None = None  # None: every contact gives its own plot
    extent: Extent = ONE_PLOT  # every contact gives one plot
    has_own_plots: bool = False  # no plot is ever that of two tracks

    def with_sensor(self, sensor: ResolvingSensor) -> Setup:
        """Return the same for another state of the sensor: filters keep what they worked out."""
        rule = self.resolution and replace(self.resolution, sensor=sensor)
        return replace(self, sensor=sensor, resolution=rule)

    def with_speed_max(self, speed: float) -> Setup:
        """Return the same with this speed of the fastest contact [m/s]."""
        if speed == self.initiation.speed_max:
            return self
        initiation = replace(self.initiation, speed_max=speed)
        return replace(self, initiation=initiation, extent=replace(self.extent, speed_max=speed))
