# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the messages of a sonar are, and how its tracks are told and drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import replace
from typing import Any

import numpy as np

from msg_adapters.bearing_tracks import from_bearing_tracks, located_bodies
from msg_adapters.bearings import to_bearings
from msg_adapters.bodies import Bodies
from msg_adapters.fans import Fans, to_fan_markers
from msg_adapters.message_types import MessageTypes
from msg_adapters.reading import Reading
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.doubts import doubts
from sonar_tracker.memory import recall, remember
from sonar_tracker.sensor_config import MountConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings, Floats, Tracks
from tracking_core.platform import Platform, pose_at
from tracking_session.axes import check_axes, Warn
from tracking_session.doubts import Doubt
from tracking_session.frames import TrackingFrame
from tracking_session.ledger import Log
from tracking_session.node_config import NodeConfig
from tracking_session.session import Session


def sonar_session(
    config: SonarTrackerConfig, node_config: NodeConfig, types: MessageTypes, log: Log
) -> Session:
    """Return what a sonar node or a replay drives."""
    return Session(SonarInstrument(config, node_config, types), node_config, types, log)


class SonarInstrument:
    """
    A sonar and its tracker.

    Parameters
    ----------
    config : SonarTrackerConfig
        Of the tracker.
    node_config : NodeConfig
        Of the messages.
    types : MessageTypes
        Classes of the messages that come out.

    """

    topic = 'bearings'

    def __init__(
        self, config: SonarTrackerConfig, node_config: NodeConfig, types: MessageTypes
    ) -> None:
        self.tracker = SonarTracker(config)
        self._overrides, self._types = vars(node_config.fields), types
        self._tells_noise = self._is_true = False

    @property
    def is_mounted(self) -> bool:
        """Whether the mount is not the platform's origin."""
        return self.tracker.config.sensor.mount != MountConfig()

    @property
    def shares_stamps(self) -> bool:
        """Whether a cycle comes in several messages."""
        return self.tracker.config.scan.period > 0.0

    @property
    def reach(self) -> float:
        """The farthest contact [m]."""
        return self.tracker.config.ranging.range_max

    def read(self, msg: Any, mapping: Mapping[str, str]) -> Reading[Bearings]:
        """Return the marks of a message."""
        config = self.tracker.config
        reading = to_bearings(msg, config.sensor, config.max_plots, self._overrides)
        return replace(reading, note='') if self.shares_stamps else reading

    def moments(self, plots: Bearings) -> Floats:
        """Return the times (K,) [s] at which own ship must be known."""
        return np.append(plots.time, plots.stamp)

    def check(self, frame: TrackingFrame, warn: Warn) -> None:
        """Warn of what looks wrong with how marks are told in this frame."""
        check_axes(self.tracker.config.sensor, frame, warn)

    def track(self, plots: Bearings, platform: Platform | None, frame: TrackingFrame) -> Tracks:
        """Follow all contacts through the marks of one cycle."""
        sensor = self.tracker.config.sensor
        if len(plots):
            self._tells_noise = bool(np.isfinite(plots.bearing_sd).any())
        self._is_true = frame.tells_true(sensor.azimuth_reference)
        if self._is_true:
            pose = pose_at(platform, plots.time)
            plots = self.tracker.sonar.in_sensor_axes(plots, pose)
        return self.tracker.track(plots, platform)

    def doubts(self) -> Iterator[Doubt]:
        """Yield what the marks say against the parameters."""
        return doubts(self.tracker, self._tells_noise, self._is_true)

    def to_table(self, previous: Tracks, header: Any) -> Any:
        """Return the track table."""
        config = self.tracker.config
        return from_bearing_tracks(
            previous, self.tracker.tracks, self.tracker.ranges(), header, self._types,
            directions=bearing_states, output=config.output,
            gate_probability=config.gate.probability,
        )  # fmt: skip

    def to_bodies(self) -> Bodies:
        """Return the confirmed tracks whose range is known."""
        tracks = self.tracker.tracks
        return located_bodies(tracks, self.tracker.ranges(), tracks.confirmed)

    def remember(self) -> dict[str, Any]:
        """Return what the tracker knows, for a restart."""
        return remember(self.tracker)

    def recall(self, memory: dict[str, Any]) -> None:
        """Go on from what was remembered; ValueError where it does not fit."""
        recall(self.tracker, memory)

    def follow(self) -> None:
        """Do nothing: fans have no trails."""

    def draw(self, shown: Set[int], header: Any, markers: Any) -> Any:
        """Return the MarkerArray of the tracks."""
        tracks, everyone = self.tracker.tracks, np.ones(len(self.tracker.tracks), bool)
        located = located_bodies(tracks, self.tracker.ranges(), everyone)
        return to_fan_markers(
            tracks, self._fans(tracks, markers.length), located, shown, header, self._types,
            lead_time=markers.lead_time,
        )  # fmt: skip

    def _fans(self, tracks: Tracks, length: float) -> Fans:
        sensor, coverage = self.tracker.config.sensor, self.tracker.coverage
        states = bearing_states(tracks, self.tracker.config.output)
        is_blind = sensor.array == 'linear' and not sensor.both_sides  # to a contact's side
        return Fans(
            bearing=states.bearing,
            bearing_sd=states.bearing_sd,
            gate=tracks.gate_size[:, 0],
            origin=coverage.sensor_position,
            axis=coverage.sector_centre - sensor.sector_centre if is_blind else None,
            length=length,
        )
