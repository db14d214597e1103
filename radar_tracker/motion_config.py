# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters say how contacts move?"""

from __future__ import annotations

from dataclasses import dataclass, field

from tracking_core.config import check_quiet_first, parameter, validate


@dataclass(frozen=True)
class PlaneMotionConfig:
    """Modes of one plane: one value per mode, the quiet mode first."""

    acceleration_sd: tuple[float, ...] = parameter(
        (3.0, 35.0),
        unit='m/s^2',
        doc='acceleration noise of each mode, the quiet mode first',
        low=1e-6,
    )
    sojourn_time: tuple[float, ...] = parameter(
        (89.6, 89.6), unit='s', doc='mean time spent in each mode', low=1e-3
    )
    turn_rate: tuple[float, ...] = parameter(
        (0.0, 0.0), unit='rad/s', doc='turn of each mode, anticlockwise (horizontal plane)',
        low=-3.2, high=3.2,
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits and lists of unequal length."""
        validate(self)
        lengths = {len(self.acceleration_sd), len(self.sojourn_time), len(self.turn_rate)}
        if lengths == {0} or len(lengths) != 1:
            raise ValueError(
                f'{type(self).__name__}: acceleration_sd, sojourn_time and turn_rate must have '
                f'one value per mode, got {len(self.acceleration_sd)}, {len(self.sojourn_time)} '
                f'and {len(self.turn_rate)}'
            )
        if self.turn_rate[0] and 0.0 in self.turn_rate:
            raise ValueError(
                f'{type(self).__name__}.turn_rate must be 0 in the first mode, the quiet one, '
                f'got {list(self.turn_rate)}'
            )
        alike = [sd for sd, rate in zip(self.acceleration_sd, self.turn_rate, strict=True)
                 if rate == self.turn_rate[0]]  # fmt: skip
        check_quiet_first(self, 'acceleration_sd', alike)


@dataclass(frozen=True)
class VerticalMotionConfig:
    """Modes of the vertical plane."""

    acceleration_sd: tuple[float, ...] = parameter(
        (3.0, 25.0),
        unit='m/s^2',
        doc='acceleration noise of each mode, the quiet mode first',
        low=1e-6,
    )
    sojourn_time: tuple[float, ...] = parameter(
        (89.6, 89.6), unit='s', doc='mean time spent in each mode', low=1e-3
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits and lists of unequal length."""
        validate(self)
        if not 0 < len(self.acceleration_sd) == len(self.sojourn_time):
            raise ValueError(
                'VerticalMotionConfig: acceleration_sd and sojourn_time must have one value per '
                f'mode, got {len(self.acceleration_sd)} and {len(self.sojourn_time)}'
            )
        check_quiet_first(self, 'acceleration_sd')


@dataclass(frozen=True)
class MotionConfig:
    """How contacts move; the planes are independent."""

    horizontal: PlaneMotionConfig = field(default_factory=PlaneMotionConfig)
    vertical: VerticalMotionConfig = field(default_factory=VerticalMotionConfig)
