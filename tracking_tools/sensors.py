# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which sensors there are, and what drives the messages of each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_session.node_config import Configs
from tracking_session.session import Session


@dataclass(frozen=True)
class SensorKind:
    """One kind of sensor, as the tools see it."""

    node: str  # its name, and the package it is in
    topic: str  # where its plots are
    configs: Configs  # defaults
    make_session: Callable[..., Session]
    picture: str  # module that draws a recording and its tracks

    @property
    def kind(self) -> str:
        """What it is called in `SENSORS`."""
        return self.node.removesuffix('_tracker')


SENSORS = {
    'radar': SensorKind(
        'radar_tracker',
        'plots',
        (RadarTrackerConfig(), radar_node_config()),
        radar_session,
        'tracking_tools.picture',
    ),
    'sonar': SensorKind(
        'sonar_tracker',
        'bearings',
        (SonarTrackerConfig(), sonar_node_config()),
        sonar_session,
        'tracking_tools.bearing_picture',
    ),
}
