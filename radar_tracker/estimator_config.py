# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters have the estimators with given gains?"""

from __future__ import annotations

from dataclasses import dataclass, field

from tracking_core.alpha_beta import READINGS
from tracking_core.config import parameter, validate
from tracking_core.fuzzy import FuzzySets, KHACHATUROV, Rules


@dataclass(frozen=True)
class AdaptiveConfig:
    """How `adaptive_alpha_beta` finds a manoeuvre and what it does then."""

    false_alarm: float = parameter(
        1e-3, unit='1', doc='chance of a look to declare a manoeuvre without one', low=1e-9,
        high=0.5,
    )  # fmt: skip
    ramp: int = parameter(
        7, unit='looks', doc='the gain falls from the last alpha to the first', low=1, high=1000
    )
    restartable: bool = parameter(
        False, unit='', doc='a detection while the gain falls starts the fall again'
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class FuzzyConfig:
    """How `fuzzy_alpha_beta` and `two_point` find a manoeuvre; rules of the former."""

    false_alarm: float = parameter(
        0.01, unit='1', doc='chance of a look to declare a manoeuvre without one', low=1e-9,
        high=0.5,
    )  # fmt: skip
    innovation_peaks: tuple[float, ...] = parameter(
        KHACHATUROV.condition.peaks, unit='1', low=0.0,
        doc='where the sets very small, small, ... of the normalised innovation are full',
    )  # fmt: skip
    gain_peaks: tuple[float, ...] = parameter(
        KHACHATUROV.conclusion.peaks, unit='1', low=0.0, high=1.0,
        doc='where the sets very small, small, ... of the raise of the gain are full, '
        '0: alpha, 1: 1',
    )  # fmt: skip
    rules: tuple[int, ...] = parameter(
        sum(KHACHATUROV.table, ()), unit='1', low=0,
        doc='set of the raise, 0: very small, ...; a row for each innovation before, in a row a '
        'column for each innovation now',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits, and sets and rules that do not fit together."""
        validate(self)
        self.table()

    def table(self) -> Rules:
        """Return sets and rules as the estimator takes them."""
        size = len(self.innovation_peaks)
        if len(self.rules) != size * size:
            raise ValueError(
                f'FuzzyConfig.rules must have {size} x {size} entries, one per pair of '
                f'innovation_peaks, got {len(self.rules)}'
            )
        rows = tuple(tuple(self.rules[i * size : (i + 1) * size]) for i in range(size))
        return Rules(FuzzySets(self.innovation_peaks), FuzzySets(self.gain_peaks), rows)


@dataclass(frozen=True)
class AlphaBetaConfig:
    """Gains of the alpha-beta estimators; beta = alpha^2 / (2 - alpha)."""

    alpha: tuple[float, ...] = parameter(
        (0.3, 0.7), unit='1', low=0.01, high=0.99,
        doc='gain of each mode, from the quiet mode up; alpha_beta has the first only',
    )  # fmt: skip
    covariance: str = parameter(
        'steady_state', unit='', choices=READINGS,
        doc='with the process noise that the gains are best for, or plot noise alone',
    )  # fmt: skip
    stay_probability: float = parameter(
        0.9, unit='1', doc='chance to be in the same mode at the next look', low=0.01, high=0.999
    )
    adaptive: AdaptiveConfig = field(default_factory=AdaptiveConfig)
    fuzzy: FuzzyConfig = field(default_factory=FuzzyConfig)

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if not self.alpha:
            raise ValueError('AlphaBetaConfig.alpha must have one value per mode, got none')
        if list(self.alpha) != sorted(self.alpha):
            raise ValueError(
                'AlphaBetaConfig.alpha must not fall from the quiet mode to the last, '
                f'got {list(self.alpha)}'
            )
