# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters say what the radar measures, how well, and where it stands?"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from msg_adapters.azimuths import angle_unit, azimuth_convention, azimuth_reference
from tracking_core.config import parameter, validate
from tracking_core.mount_config import mount_offset, mount_yaw


@dataclass(frozen=True)
class MountConfig:
    """Where the radar sits on its platform."""

    x: float = mount_offset('forward of')
    y: float = mount_offset('left of')
    z: float = mount_offset('above')
    yaw: float = mount_yaw()

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class SensorConfig:
    """What the radar measures, how well, and where."""

    range_sd: float = parameter(
        50.0, unit='m', low=1e-3,
        doc='range noise; 0.03 times the distance of the farthest plot is used at most',
    )  # fmt: skip
    azimuth_sd: float = parameter(0.00175, unit='rad', doc='azimuth noise', low=1e-6, high=0.5)
    elevation_sd: float = parameter(0.0026, unit='rad', doc='elevation noise', low=1e-6, high=0.5)
    range_rate_sd: float = parameter(2.0, unit='m/s', doc='range rate noise', low=1e-3)
    position_sd: float = parameter(
        30.0, unit='m', low=1e-3,
        doc='noise of Cartesian plots; '
        '0.03 times the distance of the farthest plot is used at most',
    )  # fmt: skip
    detection_probability: float = parameter(
        0.9, unit='1', low=0.01, high=0.999, live=True,
        doc='chance that a look at a contact gives a plot; '
        'a track whose looks say less has its own, down to 2/3 of this',
    )  # fmt: skip
    range_resolution: float = parameter(
        0.0, unit='m', low=0.0, high=1e5,
        doc='contacts nearer than this in range and azimuth_resolution give one plot; '
        '0: every contact gives its own',
    )  # fmt: skip
    azimuth_resolution: float = parameter(
        0.0, unit='rad', low=0.0, high=1.0,
        doc='contacts nearer than this in azimuth, and in elevation (3-D radar), and than '
        'range_resolution in range give one plot; both are set, or neither',
    )  # fmt: skip
    contact_size: float = parameter(
        0.0, unit='m', low=0.0, high=1e4,
        doc='a contact may give several plots, as far apart as this: they are made one; contacts '
        'nearer to each other are one, too; 0: a contact gives one plot',
    )  # fmt: skip
    dimensions: int = parameter(
        0,
        unit='1',
        doc='2 or 3; 0: as the plots tell (elevation or z before a track is confirmed, and again '
        'within 100 plots: 3)',
        low=0,
        high=3,
    )
    angle_unit: str = angle_unit()
    azimuth_convention: str = azimuth_convention()
    azimuth_reference: str = azimuth_reference()
    range_rate_sign: int = parameter(
        1, unit='1', doc='1: receding is positive, -1: approaching is positive', low=-1, high=1
    )
    range_min: float = parameter(0.0, unit='m', doc='plots nearer than this are dropped', low=0.0)
    range_max: float = parameter(4e5, unit='m', doc='plots beyond this are dropped', low=1.0)
    sector_centre: float = parameter(
        0.0, unit='rad', doc='middle of what the sensor sees, sensor axes', low=-np.pi, high=np.pi
    )
    sector_width: float = parameter(
        2.0 * np.pi, unit='rad', doc='width of what the sensor sees', low=1e-3, high=2.0 * np.pi
    )
    elevation_span: float = parameter(
        0.7,
        unit='rad',
        doc='elevations in which false plots arise (3-D radar)',
        low=1e-3,
        high=3.2,
    )
    range_rate_max: float = parameter(
        600.0, unit='m/s', doc='false plots have range rates up to this, either sign', low=0.1
    )
    range_rate_interval: float = parameter(
        0.0, unit='m/s', low=0.0,
        doc='ambiguous range rates come again after so much, which is from the lowest to the '
        'highest that the sensor tells; 0: they do not',
    )  # fmt: skip
    mount: MountConfig = field(default_factory=MountConfig)

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if self.dimensions == 1:
            raise ValueError('SensorConfig.dimensions must be 0, 2 or 3, got 1')
        if self.range_rate_sign == 0:
            raise ValueError('SensorConfig.range_rate_sign must be 1 or -1, got 0')
        if (self.range_resolution > 0.0) != (self.azimuth_resolution > 0.0):
            raise ValueError(
                'SensorConfig.range_resolution and azimuth_resolution must both be 0 or both be '
                f'above 0, got {self.range_resolution} and {self.azimuth_resolution}'
            )
        if self.range_min >= self.range_max:
            raise ValueError(
                f'SensorConfig.range_min must be below range_max = {self.range_max}, '
                f'got {self.range_min}'
            )
