# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters has the sonar node beside those of the tracker: what concerns messages."""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.config import parameter, validate
from tracking_session.node_config import drawing_rate, field_name, NodeConfig


@dataclass(frozen=True)
class FieldsConfig:
    """Names of the fields in the bearings message, where they are not ours."""

    bearing: str = field_name()
    bearing_sd: str = field_name()
    snr: str = field_name()
    time: str = field_name()

    def __post_init__(self) -> None:
        """Refuse values of another type."""
        validate(self)


@dataclass(frozen=True)
class MarkersConfig:
    """How tracks are drawn while somebody looks."""

    rate: float = drawing_rate()
    length: float = parameter(
        10_000.0, unit='m', doc='length of the fans', low=1.0, high=1e7, live=True
    )
    lead_time: float = parameter(
        60.0, unit='s', low=0.0, live=True,
        doc='the arrow of a contact whose range is known ends where it will be then',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse values outside their limits."""
        validate(self)


def sonar_node_config() -> NodeConfig:
    """Return the defaults of the sonar node."""
    return NodeConfig(markers=MarkersConfig(), fields=FieldsConfig())
