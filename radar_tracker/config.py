# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters does the radar tracker have? Read this file as the table."""

from __future__ import annotations

from dataclasses import dataclass, field

from radar_tracker.estimator_config import AlphaBetaConfig
from radar_tracker.motion_config import MotionConfig
from radar_tracker.sensor_config import SensorConfig
from tracking_core.association import ASSOCIATORS, JOINT
from tracking_core.config import parameter, validate
from tracking_core.estimators import ESTIMATORS
from tracking_core.lifecycle_config import (
    ExistenceConfig,
    GateConfig,
    InitiationConfig,
    MergeConfig,
    MOfNConfig,
    UnresolvedConfig,
)


@dataclass(frozen=True)
class ScanConfig:
    """How messages become looks of the antenna."""

    assembly: str = parameter(
        'message', unit='', choices=('message', 'sector', 'rotation', 'snapshot'),
        doc='a message is a full turn, a sector of one, a sector to collect into full turns, '
        'or a look everywhere at once',
    )  # fmt: skip
    time_reference: str = parameter(
        'start', unit='', choices=('start', 'middle', 'end'),
        doc='what the stamp of a message without plot times means',
    )  # fmt: skip
    period: float = parameter(
        0.0, unit='s', low=0.0,
        doc='time of one antenna turn, of which plots without times are then taken at the middle; '
        '0: learnt from the plots. Of snapshots, time of a look that comes in several messages, '
        'as one plot each: they are collected, and used when the next look begins',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class RadarTrackerConfig:
    """All parameters of the radar tracker; the defaults are the modes of [ZHUK09]."""

    sensor: SensorConfig = field(default_factory=SensorConfig)
    scan: ScanConfig = field(default_factory=ScanConfig)
    motion: MotionConfig = field(default_factory=MotionConfig)
    alpha_beta: AlphaBetaConfig = field(default_factory=AlphaBetaConfig)
    gate: GateConfig = field(default_factory=GateConfig)
    existence: ExistenceConfig = field(default_factory=ExistenceConfig)
    m_of_n: MOfNConfig = field(default_factory=MOfNConfig)
    initiation: InitiationConfig = field(default_factory=InitiationConfig)
    merge: MergeConfig = field(default_factory=MergeConfig)
    unresolved: UnresolvedConfig = field(default_factory=UnresolvedConfig)
    estimator: str = parameter(
        'markov_jump', unit='', choices=tuple(ESTIMATORS), doc='filter of every track'
    )
    output: str = parameter(
        'mmse', unit='', choices=('mmse', 'map'), live=True,
        doc='published state: the mixture of the modes, or the most probable mode',
    )  # fmt: skip
    association: str = parameter(
        'jpda_star', unit='', choices=tuple(ASSOCIATORS), doc='how plots are shared among tracks',
        live=True,
    )  # fmt: skip
    lifecycle: str = parameter(
        'existence', unit='', choices=('existence', 'm_of_n'),
        doc='what confirms and deletes tracks',
    )  # fmt: skip
    clutter_density: float = parameter(
        0.0, unit='1/(m rad), 3-D 1/(m rad^2), Cartesian 1/m^2 or 1/m^3', low=0.0, live=True,
        doc='false plots of one look per unit of plot space, 0: learnt, place by place',
    )  # fmt: skip
    longest_pause: float = parameter(
        0.0, unit='s', low=0.0, live=True,
        doc='after a pause that is longer, three turns of the antenna at least, tracks end, since '
        'nobody knows who is who; of snapshots set several intervals; 0: they go on',
    )  # fmt: skip
    max_tracks: int = parameter(
        5000, unit='1', doc='new tracks are refused beyond', low=1, high=200_000
    )
    max_plots: int = parameter(
        20_000, unit='1', low=1, high=1_000_000,
        doc='a message with more rows is refused, a collected turn with more comes in parts',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if self.association in JOINT:
            return
        for name in ('range_resolution', 'contact_size'):
            if getattr(self.sensor, name) > 0.0:
                raise ValueError(
                    'RadarTrackerConfig.association must be jpda or jpda_star where '
                    f'sensor.{name} is above 0, got {self.association}'
                )
