# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters does the sonar tracker have? Read this file as the table."""

from __future__ import annotations

from dataclasses import dataclass, field

from sonar_tracker.motion_config import MotionConfig
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.sensor_config import SensorConfig
from tracking_core.association import ASSOCIATORS, JOINT
from tracking_core.config import parameter, validate
from tracking_core.estimators import BEARING_ESTIMATORS
from tracking_core.lifecycle import LIFECYCLES
from tracking_core.lifecycle_config import (
    ErrorRatioConfig,
    ExistenceConfig,
    GateConfig,
    MergeConfig,
    MOfNConfig,
    UnresolvedConfig,
)

# One mark says little among false ones: tracks must be let live until they have some.
_DROP = 1e-4
# Marks are often noisier than they tell; of those outside a gate a second track starts.
_GATE = 0.9999
_ONE_MODE = ('kalman_decoupled', 'finite_memory')


@dataclass(frozen=True)
class CycleConfig:
    """How messages become cycles."""

    period: float = parameter(
        0.0, unit='s', low=0.0,
        doc='time of a cycle that comes in several messages, as one bearing each: they are '
        'collected, and used when the next cycle begins; 0: every message is a cycle',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class BearingInitiationConfig:
    """How tracks start from marks that no track claimed."""

    method: str = parameter(
        'two_point', unit='', choices=('two_point', 'one_point'),
        doc='from two marks of successive cycles, or from one with a rate prior',
    )  # fmt: skip
    rate_max: float = parameter(
        0.01, unit='rad/s', doc='fastest bearing to start on', low=1e-6, live=True
    )
    rate_sd: float = parameter(
        1e-3, unit='rad/s', doc='usual bearing rate of new contacts; 0: any up to the limit',
        low=0.0,
        live=True,
    )  # fmt: skip
    memory: float = parameter(
        2.5, unit='looks', doc='how long an unclaimed mark may wait for its second', low=1.0,
        high=10.0, live=True,
    )  # fmt: skip
    faint_starts: int = parameter(
        30, unit='1', low=0, high=10_000, live=True,
        doc='so many pairs that are less likely than usual are followed a cycle in dense clutter; '
        'more find contacts among more false marks, and cost more; m_of_n follows none',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class SonarTrackerConfig:
    """All parameters of the sonar tracker."""

    sensor: SensorConfig = field(default_factory=SensorConfig)
    scan: CycleConfig = field(default_factory=CycleConfig)
    motion: MotionConfig = field(default_factory=MotionConfig)
    gate: GateConfig = field(default_factory=lambda: GateConfig(probability=_GATE))
    existence: ExistenceConfig = field(default_factory=lambda: ExistenceConfig(drop=_DROP))
    m_of_n: MOfNConfig = field(default_factory=lambda: MOfNConfig(hits=4, looks=6))
    error_ratio: ErrorRatioConfig = field(default_factory=ErrorRatioConfig)
    initiation: BearingInitiationConfig = field(default_factory=BearingInitiationConfig)
    unresolved: UnresolvedConfig = field(default_factory=UnresolvedConfig)
    merge: MergeConfig = field(default_factory=lambda: MergeConfig(distance=2.0))
    ranging: RangingConfig = field(default_factory=RangingConfig)
    estimator: str = parameter(
        'modified_polar', unit='', choices=tuple(BEARING_ESTIMATORS), doc='filter of every track'
    )
    output: str = parameter(
        'mmse', unit='', choices=('mmse', 'map'), live=True,
        doc='published state: the mixture of the modes, or the most probable mode',
    )  # fmt: skip
    association: str = parameter(
        'jpda', unit='', choices=tuple(ASSOCIATORS), doc='how marks are shared among tracks',
        live=True,
    )  # fmt: skip
    lifecycle: str = parameter(
        'existence', unit='', choices=tuple(LIFECYCLES), doc='what confirms and deletes tracks'
    )
    clutter_density: float = parameter(
        0.0, unit='1/rad', low=0.0, live=True,
        doc='false marks of one cycle; 0: learnt, bearing by bearing',
    )  # fmt: skip
    longest_pause: float = parameter(
        0.0, unit='s', low=0.0, live=True,
        doc='after a pause that is longer, tracks end, since nobody knows who is who: set several '
        'intervals of the messages at least; 0: they go on',
    )  # fmt: skip
    max_tracks: int = parameter(
        1000, unit='1', doc='new tracks are refused beyond', low=1, high=200_000
    )
    max_plots: int = parameter(
        5000, unit='1', doc='a message with more rows is refused', low=1, high=1_000_000
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits, and what does not go together."""
        validate(self)
        modes = len(self.motion.sojourn_time)
        if self.estimator in _ONE_MODE and modes > 1:
            raise ValueError(
                f'SonarTrackerConfig.motion must have one mode with the estimator '
                f'{self.estimator}, got {modes}'
            )
        if self.sensor.bearing_resolution > 0.0 and self.association not in JOINT:
            raise ValueError(
                'SonarTrackerConfig.association must be jpda or jpda_star where '
                f'sensor.bearing_resolution is above 0, got {self.association}'
            )
