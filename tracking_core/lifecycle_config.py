# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters do gate, lifecycle, initiation and merging share between the trackers?"""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.config import parameter, validate


@dataclass(frozen=True)
class GateConfig:
    """How far from its prediction a plot may fall and still belong to a track."""

    probability: float = parameter(
        0.997, unit='1', doc='chance that the true plot falls inside', low=0.5, high=0.999999,
        live=True,
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class ExistenceConfig:
    """When a track is believed: integrated existence probability (JIPDA)."""

    new_contacts: float = parameter(
        60.0, unit='1/h', doc='new contacts expected in the whole coverage', low=1e-3, live=True
    )
    lifetime: float = parameter(
        3600.0, unit='s', doc='mean time that a contact stays in the coverage', low=1.0, live=True
    )
    confirm: float = parameter(
        0.98, unit='1', doc='a track at or above is confirmed', low=0.5, high=0.999999, live=True
    )
    drop: float = parameter(
        0.02, unit='1', low=1e-9, high=0.5, live=True,
        doc='a track below is deleted; in dense clutter a tentative one later',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class MOfNConfig:
    """When a track is believed: plots counted in its looks."""

    hits: int = parameter(3, unit='1', doc='plots that confirm a track', low=1, high=60, live=True)
    looks: int = parameter(
        5, unit='1', low=1, high=60, live=True,
        doc='a track with fewer plots than hits in so many looks from its start is deleted',
    )  # fmt: skip
    drop_misses: int = parameter(
        5, unit='1', doc='a confirmed track is deleted after so many misses in a row', low=1,
        high=60, live=True,
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if self.hits > self.looks:
            raise ValueError(f'MOfNConfig.hits must be at most looks = {self.looks}, '
                             f'got {self.hits}')  # fmt: skip


@dataclass(frozen=True)
class InitiationConfig:
    """How tracks start from plots that no track claimed."""

    method: str = parameter(
        'two_point', unit='', choices=('two_point', 'one_point'),
        doc='from two plots in successive looks, or from one with a velocity prior, whose gates '
        'are so wide that m_of_n confirms clutter',
    )  # fmt: skip
    speed_max: float = parameter(
        600.0, unit='m/s', doc='fastest contact to start on', low=1e-6, live=True
    )
    speed_sd: float = parameter(
        0.0, unit='m/s', low=0.0, live=True,
        doc='usual speed of new contacts on each axis, which tames two noisy plots; 0: any up to '
        'the limit is as usual',
    )  # fmt: skip
    climb_max: float = parameter(
        100.0, unit='m/s', doc='steepest climb or descent to start on (3-D)', low=0.1, live=True
    )
    memory: float = parameter(
        2.5, unit='looks', doc='how long an unclaimed plot may wait for its second', low=1.0,
        high=10.0, live=True,
    )  # fmt: skip
    faint_starts: int = parameter(
        30, unit='1', low=0, high=10_000, live=True,
        doc='so many pairs that are less likely than usual are followed a look in dense clutter; '
        'more find contacts among more false plots, and cost more; m_of_n follows none',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class ErrorRatioConfig:
    """When a track is believed: looks that sharpened it, counted [VORONINA19] (15)."""

    ratio: float = parameter(
        0.9999, unit='1', doc='sd after over sd before; a look at or above gave nothing', low=0.5,
        high=1.0, live=True,
    )  # fmt: skip
    hits: int = parameter(4, unit='1', doc='looks that sharpen it confirm a track', low=1, high=60,
                          live=True)  # fmt: skip
    looks: int = parameter(
        6, unit='1', low=1, high=60, live=True,
        doc='a track sharpened by fewer than hits of so many looks from its start is deleted',
    )  # fmt: skip
    drop_misses: int = parameter(
        5, unit='1', doc='a confirmed track is deleted after so many looks in a row that gave '
        'nothing', low=1, high=60, live=True,
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if self.hits > self.looks:
            raise ValueError(f'ErrorRatioConfig.hits must be at most looks = {self.looks}, '
                             f'got {self.hits}')  # fmt: skip


@dataclass(frozen=True)
class MergeConfig:
    """When two tracks are one contact."""

    distance: float = parameter(
        0.5, unit='1', low=0.0, high=10.0, live=True,
        doc='states closer than this Mahalanobis distance are duplicates; 0: never merge',
    )  # fmt: skip

    looks: int = parameter(
        6, unit='1', low=1, high=100, live=True,
        doc='two confirmed tracks are one contact after so many looks in a row within distance; '
        'a look with a plot of each ends the row, unless contacts may share plots (association '
        'pda, or a resolution is set)',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class UnresolvedConfig:
    """What is known of plots that belong to more than one contact."""

    softness: float = parameter(
        0.3, unit='1', low=1e-3, high=1.0, live=True,
        doc='sd of the limit of resolution, as a part of it',
    )  # fmt: skip
    spread: float = parameter(
        1.0, unit='1', low=0.0, high=1000.0, live=True,
        doc='variance of a common plot about the mean by level, as a part of the spread of the '
        'contacts',
    )  # fmt: skip
    interference: float = parameter(
        0.1, unit='1', low=0.0, high=1.0, live=True,
        doc='sd of plots of contacts near the limit of resolution, as a part of it: each plot '
        'is pulled by the other contact',
    )  # fmt: skip
    capture: float = parameter(
        0.3, unit='1', low=1e-6, high=0.999, live=True,
        doc='chance that the common plot is that of one contact, which drowns the others',
    )  # fmt: skip
    least_chance: float = parameter(
        0.01, unit='1', low=1e-6, high=0.5, live=True,
        doc='contacts that are less likely to have one plot are taken as apart',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
