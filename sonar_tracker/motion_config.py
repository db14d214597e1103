# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters say how bearings move?"""

from __future__ import annotations

from dataclasses import dataclass

from sonar_tracker.range_prior import RANGE_PRIORS
from tracking_core.config import check_quiet_first, parameter, validate


@dataclass(frozen=True)
class MotionConfig:
    """Modes of the bearing: one value per mode, the quiet mode first."""

    bearing_noise: tuple[float, ...] = parameter(
        (5e-5,), unit='rad/sqrt(s)', doc='drift of the bearing in each mode', low=0.0
    )
    rate_noise: tuple[float, ...] = parameter(
        (3e-6,), unit='rad/s/sqrt(s)', low=0.0,
        doc='drift of the bearing rate in each mode; modified_polar: and of range rate over range',
    )  # fmt: skip
    sojourn_time: tuple[float, ...] = parameter(
        (600.0,), unit='s', doc='mean time spent in each mode', low=1e-3
    )
    closing_sd: float = parameter(
        1e-3, unit='1/s', low=1e-9,
        doc='range rate over range of new contacts (modified_polar)',
    )  # fmt: skip
    range_min: float = parameter(
        500.0, unit='m', doc='nearest new contact (modified_polar)', low=1.0
    )
    range_max: float = parameter(
        50_000.0, unit='m', doc='farthest new contact (modified_polar)', low=1.0
    )
    range_prior: str = parameter(
        'inverse', unit='', choices=tuple(RANGE_PRIORS),
        doc='between these, new contacts are spread evenly over 1/range, which takes near ones '
        'for likely, or evenly over the sea: better if the limits are known (modified_polar)',
    )  # fmt: skip
    memory: int = parameter(
        15, unit='looks', doc='looks in the line (finite_memory)', low=2, high=1000
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits and lists of unequal length."""
        validate(self)
        lengths = {len(self.bearing_noise), len(self.rate_noise), len(self.sojourn_time)}
        if lengths == {0} or len(lengths) != 1:
            raise ValueError(
                'MotionConfig: bearing_noise, rate_noise and sojourn_time must have one value per '
                f'mode, got {len(self.bearing_noise)}, {len(self.rate_noise)} and '
                f'{len(self.sojourn_time)}'
            )
        check_quiet_first(self, 'rate_noise')
        if self.range_min >= self.range_max:
            raise ValueError(
                f'MotionConfig.range_min must be below range_max = {self.range_max}, '
                f'got {self.range_min}'
            )
