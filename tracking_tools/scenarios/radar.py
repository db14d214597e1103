# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a simulated radar is, and where and when its antenna looks."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Literal

import numpy as np

from tracking_core.batches import Bools, Floats
from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios.legs import Legs
from tracking_tools.scenarios.trajectory import Trajectory

NORTH = math.pi / 2
_ROUNDING = 1e-9
AT_ORIGIN = Legs(position=(0.0, 0.0, 0.0), speed=0.0, course=0.0)


@dataclass(frozen=True)
class SimulatedRadar:
    """
    A radar: turning (``clockwise``, ``anticlockwise``) or ``staring``.

    It measures range (slant; over the ground if 2-D), azimuth (anticlockwise from east) and what
    has a standard deviation besides. A staring radar sees everything at the beginning of each
    period.
    """

    period: float
    """One turn, or one look of a staring radar [s]."""
    range_sd: float
    """[m]."""
    azimuth_sd: float
    """[rad]."""
    elevation_sd: float | None = None
    """[rad]; None: a 2-D radar."""
    range_rate_sd: float | None = None
    """[m/s]; None: not measured."""
    position_sd: float = 0.0
    """Above 0, the plots are Cartesian with this noise on each axis [m]."""
    detection_probability: float = 0.9
    clutter_per_turn: float = 0.0
    """Mean number of false plots in a turn, uniform in the measured coordinates."""
    rotation: Literal['clockwise', 'anticlockwise', 'staring'] = 'clockwise'
    azimuth_start: float = NORTH
    """Where a turn and its message begin [rad]."""
    range_limits: tuple[float, float] = (500.0, 100_000.0)
    """[m]."""
    azimuth_coverage: tuple[float, float] = (-math.pi, 2.0 * math.pi)
    """Where it begins, and how far it reaches anticlockwise [rad]."""
    elevation_limits: tuple[float, float] = (-math.pi / 2, math.pi / 2)
    """[rad]."""
    range_rate_limit: float = 350.0
    """False plots have range rates up to this [m/s]."""
    range_resolution: float = 0.0
    """Plots of one pass closer than this and ``azimuth_resolution`` become one [m]."""
    azimuth_resolution: float = 0.0
    """[rad]; 0 in either: never."""
    platform: Trajectory = AT_ORIGIN
    """Where the antenna stands; its axes stay east, north, up."""

    def __post_init__(self) -> None:
        if not self.period > 0.0:
            raise ValueError(f'SimulatedRadar.period must be above 0 s, got {self.period}')
        if not 0.0 <= self.detection_probability <= 1.0:
            raise ValueError(
                'SimulatedRadar.detection_probability must be in [0, 1], '
                f'got {self.detection_probability}'
            )

    @property
    def is_staring(self) -> bool:
        """Whether it sees all directions at once."""
        return self.rotation == 'staring'

    @property
    def antenna_rate(self) -> float:
        """Turn rate of the antenna, anticlockwise positive [rad/s]; 0 when staring."""
        sense = {'clockwise': -1.0, 'anticlockwise': 1.0, 'staring': 0.0}[self.rotation]
        return sense * 2.0 * math.pi / self.period

    def turns(self, duration: float) -> int:
        """Return how many turns, or looks, begin in that time [s]."""
        return math.ceil(duration / self.period - _ROUNDING)

    def antenna_azimuth(self, time: Floats) -> Floats:
        """Where the antenna points at these times [rad]."""
        azimuth: Floats = wrap_angle(self.azimuth_start + self.antenna_rate * np.asarray(time))
        return azimuth

    def time_into_turn(self, azimuth: Floats) -> Floats:
        """How long after the beginning of a turn the antenna points there [s]; 0 when staring."""
        if self.is_staring:
            return np.zeros_like(azimuth)
        sense = math.copysign(1.0, self.antenna_rate)
        ahead = np.mod(sense * (azimuth - self.azimuth_start), 2.0 * math.pi)
        return ahead / abs(self.antenna_rate)

    def covers(self, place: dict[str, Floats]) -> Bools:
        """Which places (range, azimuth, elevation, each (M,)) it can see."""
        near, far = self.range_limits
        low, high = self.elevation_limits
        first, width = self.azimuth_coverage
        return (
            (near <= place['range'])
            & (place['range'] <= far)
            & (low <= place['elevation'])
            & (place['elevation'] <= high)
            & (np.mod(place['azimuth'] - first, 2.0 * math.pi) <= width)
        )
