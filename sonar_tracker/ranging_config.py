# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters does the range from bearings have?"""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.config import parameter, validate


@dataclass(frozen=True)
class RangingConfig:
    """How ranges are fitted to the bearings of confirmed tracks, and when they are believed."""

    enabled: bool = parameter(True, unit='', doc='whether ranges are looked for at all')
    tracks_per_cycle: int = parameter(
        2, unit='1', doc='tracks fitted in each cycle, in turn; bounds the time it takes',
        low=1, high=10_000,
    )  # fmt: skip
    relative_sd: float = parameter(
        0.2, unit='1', low=0.001, high=0.5,
        doc='a range is observable where its sd is below this part of it',
    )  # fmt: skip
    velocity_noise: float = parameter(
        0.003, unit='m/s/sqrt(s)', low=0.0, high=10.0,
        doc='drift of the velocity of contacts that a range must stand to be observable; its sd '
        'is that of this and of larger and smaller drifts, as far as the marks allow them',
    )  # fmt: skip
    heading_noise: float = parameter(
        0.0035, unit='rad', low=0.0, high=0.5,
        doc="error of own ship's heading, lasting about half a minute, that a range must stand; "
        'more where own ship tells more',
    )  # fmt: skip
    false_alarm: float = parameter(
        1e-4, unit='1', low=1e-12, high=0.1,
        doc='chance that the marks of a straight course are taken for those of another motion',
    )  # fmt: skip
    window: float = parameter(
        2400.0, unit='s', doc='marks older than this are forgotten', low=1.0, high=1e6
    )
    points: int = parameter(
        128, unit='1', low=16, high=4096,
        doc='marks kept of each track; when there are more, neighbours are averaged',
    )  # fmt: skip
    least_points: int = parameter(12, unit='1', doc='fewer marks are not fitted', low=6, high=4096)
    range_min: float = parameter(50.0, unit='m', doc='nearest contact', low=0.1)
    range_max: float = parameter(100_000.0, unit='m', doc='farthest contact', low=1.0)

    def __post_init__(self) -> None:
        """Refuse values outside their limits, and what does not go together."""
        validate(self)
        if self.range_min >= self.range_max:
            raise ValueError(
                f'RangingConfig.range_min must be below range_max = {self.range_max}, '
                f'got {self.range_min}'
            )
        if self.least_points > self.points // 2:
            raise ValueError(
                f'RangingConfig.least_points must be at most points / 2 = {self.points // 2}, '
                f'got {self.least_points}'
            )

    def heading_error(self, told: float) -> float:
        """Return the error of the heading [rad] that a range must stand; own ship tells one."""
        return max(self.heading_noise, told)
