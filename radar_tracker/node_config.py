# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters has the radar node beside those of the tracker: what concerns messages."""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.config import parameter, validate
from tracking_session.node_config import drawing_rate, field_name, NodeConfig


@dataclass(frozen=True)
class FieldsConfig:
    """Names of the fields in the plots message, where they are not those of the documentation."""

    range: str = field_name()
    azimuth: str = field_name()
    elevation: str = field_name()
    x: str = field_name()
    y: str = field_name()
    z: str = field_name()
    range_rate: str = field_name()
    snr: str = field_name()
    time: str = field_name()
    range_sd: str = field_name()
    azimuth_sd: str = field_name()
    elevation_sd: str = field_name()
    range_rate_sd: str = field_name()

    def __post_init__(self) -> None:
        """Refuse values of another type."""
        validate(self)


@dataclass(frozen=True)
class MarkersConfig:
    """How tracks are drawn while somebody looks."""

    rate: float = drawing_rate()
    history: int = parameter(
        20, unit='scans', doc='length of the trail behind a track', low=1, high=1000
    )
    lead_time: float = parameter(
        30.0, unit='s', doc='the arrow ends where the contact will be then', low=0.0, live=True
    )

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


def radar_node_config() -> NodeConfig:
    """Return the defaults of the radar node."""
    return NodeConfig(markers=MarkersConfig(), fields=FieldsConfig())
