# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters say what the sonar hears, how well, and where it is?"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from msg_adapters.azimuths import angle_unit, azimuth_convention, azimuth_reference
from tracking_core.config import parameter, validate
from tracking_core.mount_config import mount_offset, mount_yaw

_ALL_AROUND = 6.28  # rad, as a full turn is written


@dataclass(frozen=True)
class MountConfig:
    """Where the sonar sits on its platform."""

    x: float = mount_offset('forward of')
    y: float = mount_offset('left of')
    yaw: float = mount_yaw()

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class SensorConfig:
    """What the sonar hears, how well, and where."""

    array: str = parameter(
        'omnidirectional', unit='', choices=('omnidirectional', 'linear'),
        doc='a linear array along the x axis of the sensor is blurred by 1 / sin(bearing) and '
        'cannot tell left from right',
    )  # fmt: skip
    both_sides: bool = parameter(
        False, unit='',
        doc='linear array: each mark counts on both sides of the axis; where own ship turns the '
        'track of the contact goes on, that of its image ends',
    )  # fmt: skip
    bearing_sd: float = parameter(
        0.01,
        unit='rad',
        low=1e-6,
        high=0.5,
        doc='bearing noise of marks that do not tell theirs (linear array: at broadside)',
    )
    bearing_sd_min: float = parameter(
        0.0, unit='rad', doc='marks that tell less are not believed', low=0.0, high=0.5
    )
    detection_probability: float = parameter(
        0.9, unit='1', low=0.01, high=0.999, live=True,
        doc='chance that a cycle gives a mark of a contact; '
        'a track whose looks say less has its own, down to 2/3 of this',
    )  # fmt: skip
    bearing_resolution: float = parameter(
        0.0, unit='rad', low=0.0, high=1.0,
        doc='contacts nearer than this give one mark (linear array: at broadside); '
        '0: every contact gives its own',
    )  # fmt: skip
    angle_unit: str = angle_unit()
    azimuth_convention: str = azimuth_convention()
    azimuth_reference: str = azimuth_reference()
    sector_centre: float = parameter(
        0.0, unit='rad', doc='middle of what the sonar hears, sensor axes', low=-np.pi, high=np.pi
    )
    sector_width: float = parameter(
        2.0 * np.pi, unit='rad', doc='width of what the sonar hears', low=1e-3, high=2.0 * np.pi
    )
    mount: MountConfig = field(default_factory=MountConfig)

    def __post_init__(self) -> None:
        """Refuse values outside their limits, and what does not go together."""
        validate(self)
        if self.both_sides and (self.array != 'linear' or self.sector_width < _ALL_AROUND):
            raise ValueError(
                'SensorConfig.both_sides goes with array linear and sector_width of a full turn, '
                f'got {self.array} and {self.sector_width}'
            )
