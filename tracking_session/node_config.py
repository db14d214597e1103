# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters has every node beside those of its tracker: what concerns messages."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from msg_adapters.kinds.menu import check_type, POINT_CLOUD, TYPES
from msg_adapters.message_types import frame_name
from msg_adapters.radar_tracks import NAME as RADAR_TRACKS
from tracking_core.config import parameter, validate

Configs = tuple[Any, ...]  # of the tracker, then of its node
# Parameters that only say something; in the dump of a node they are no more.
TELLING = {
    'input_types_available': 'what input_type can be here',
    'output_types_available': 'what output_type can be here',
}


def field_name() -> Any:
    """Return a parameter that names a field of a message."""
    return parameter('', unit='', doc="the message's name for this field; empty: as documented")


def drawing_rate() -> Any:
    """Return the parameter that bounds how often markers are drawn."""
    return parameter(
        2.0, unit='Hz', doc='drawings per second at most; 0: none', low=0.0, high=100.0, live=True
    )


@dataclass(frozen=True)
class LateConfig:
    """What becomes of messages that come in the wrong order."""

    late: int = parameter(
        3, unit='scans', low=0, high=20,
        doc='messages up to so many scans late are used at their own time, as far as the last 512 '
        'messages go (64 with thousands of tracks, or of plots in a message); 0: none is',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class SnapshotConfig:
    """How tracks outlive their node."""

    file: str = parameter(
        '', unit='',
        doc='tracks are kept here for a restart of the node: one file for each; empty: none are',
    )  # fmt: skip
    period: float = parameter(5.0, unit='s', doc='time between two writings', low=0.1, high=3600.0)
    max_age: float = parameter(
        60.0, unit='s', doc='tracks that were kept longer ago are not restored', low=0.0, high=1e6
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


@dataclass(frozen=True)
class NodeConfig:
    """What a node needs beside the tracker's own parameters."""

    markers: Any
    """Config with the `rate` of drawings and what else the sensor's drawings need."""
    fields: Any
    """Config with the message's name for each of our fields."""
    scan: LateConfig = field(default_factory=LateConfig)
    snapshot: SnapshotConfig = field(default_factory=SnapshotConfig)
    tracking_frame: str = parameter(
        '', unit='', doc='frame of the tracks; empty: that of own ship or, without, of the plots'
    )
    autostart: bool = parameter(
        True, unit='', doc='configure and activate at once, without a lifecycle manager'
    )
    input_type: str = parameter(
        POINT_CLOUD, unit='', doc=f'message type of the plots or bearings: {", ".join(TYPES)}'
    )
    output_type: str = parameter(
        '', unit='', choices=('', RADAR_TRACKS),
        doc='message type in which contacts are published once more; empty: none',
    )  # fmt: skip
    use_tf: bool = parameter(
        False, unit='', doc='take the place of the sensor from tf2 instead of ownship and mount'
    )
    tf_patience: float = parameter(
        0.5, unit='s', doc='messages wait so long for their transform', low=0.0, high=60.0
    )
    time_jump_threshold: float = parameter(
        10.0, unit='s', doc='a stamp further off is refused until several in a row agree',
        low=0.01, high=1e6,
    )  # fmt: skip
    max_delay: float = parameter(
        1.0, unit='s', low=0.0, high=3600.0,
        doc='messages that have waited longer give way to the newest one; 0: all are used',
    )  # fmt: skip
    ownship_timeout: float = parameter(
        2.0, unit='s', doc='plots may be so far from the nearest odometry of own ship', low=0.0,
        high=3600.0,
    )  # fmt: skip
    ownship_patience: float = parameter(
        2.0, unit='s', low=0.0, high=60.0,
        doc='plots wait so long at most for odometry of own ship of their time, 0.05 s aside; '
        '0: they do not',
    )  # fmt: skip
    ownship_leap: float = parameter(
        100.0, unit='m', low=0.0, high=1e6,
        doc='a place of own ship further from where its last ones led, by more than its '
        'covariance explains, is refused until several in a row agree; 0: none is',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)
        if self.use_tf and not frame_name(self.tracking_frame):
            raise ValueError(
                'NodeConfig.use_tf needs a tracking_frame: name the frame in which to track'
            )
        try:
            check_type(self.input_type)
        except ValueError as error:
            raise ValueError(f'NodeConfig.input_type: {error}') from error
