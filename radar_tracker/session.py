# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the messages of a radar are, and how its tracks are told and drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import replace
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.bodies import Bodies
from msg_adapters.kinds.menu import is_single
from msg_adapters.markers import to_markers
from msg_adapters.message_types import MessageTypes
from msg_adapters.plots import to_plots
from msg_adapters.reading import Reading
from msg_adapters.tracks import from_tracks, kinematics, to_bodies
from msg_adapters.trails import Trails
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.doubts import doubts, height_doubts
from radar_tracker.memory import recall, remember
from radar_tracker.mounting import in_sensor_axes
from radar_tracker.part_turns import PartTurns
from radar_tracker.sensor_config import MountConfig
from radar_tracker.told import tell_noise
from radar_tracker.tracker import RadarTracker
from radar_tracker.untimed import UntimedPlots
from tracking_core.batches import Floats, Plots, Tracks
from tracking_core.platform import Platform, pose_at
from tracking_core.rows import take
from tracking_session.axes import check_axes, check_places, Warn
from tracking_session.doubts import Doubt
from tracking_session.frames import TrackingFrame
from tracking_session.ledger import Log
from tracking_session.node_config import NodeConfig
from tracking_session.session import Session


def radar_session(
    config: RadarTrackerConfig, node_config: NodeConfig, types: MessageTypes, log: Log
) -> Session:
    """Return what a radar node or a replay drives."""
    return Session(RadarInstrument(config, node_config, types), node_config, types, log)


class RadarInstrument:
    """
    A radar and its tracker.

    Parameters
    ----------
    config : RadarTrackerConfig
        Of the tracker.
    node_config : NodeConfig
        Of the messages.
    types : MessageTypes
        Classes of the messages that come out.

    """

    topic = 'plots'

    def __init__(
        self, config: RadarTrackerConfig, node_config: NodeConfig, types: MessageTypes
    ) -> None:
        self.tracker = RadarTracker(config)
        self._overrides, self._types = vars(node_config.fields), types
        self._trails = Trails.empty(node_config.markers.history)
        self._plots, self._tells_noise = 0, False  # how many came; whether they tell their own
        self._has_height = config.sensor.dimensions < 3  # or needs none
        self._untimed, self._parts = UntimedPlots(config.sensor.azimuth_sd), PartTurns()

    @property
    def is_mounted(self) -> bool:
        """Whether the mount is not the platform's origin."""
        return self.tracker.config.sensor.mount != MountConfig()

    @property
    def shares_stamps(self) -> bool:
        """Where a look in several messages is collected; an antenna needs time between sectors."""
        return self.tracker.cycles is not None

    @property
    def reach(self) -> float:
        """The radar's range [m]."""
        return self.tracker.config.sensor.range_max

    def read(self, msg: Any, mapping: Mapping[str, str]) -> Reading[Plots]:
        """Return the plots of a message, all polar or all Cartesian from first to last."""
        config = self.tracker.config
        longest = self.tracker.antenna.longest_offset
        reading = to_plots(msg, config.sensor, config.max_plots, self._overrides, longest)
        if self.shares_stamps and is_single(msg):
            reading = replace(reading, note='')
        both = mapping and len(reading.plots)
        if both and reading.is_polar != ({'range', 'azimuth'} <= mapping.keys()):
            raise BadMessage(
                'fields changed',
                f'fields were {sorted(mapping.values())}, '
                f'now {sorted(reading.mapping.values())}: polar and Cartesian plots do not mix',
            )
        return reading

    def moments(self, plots: Plots) -> Floats:
        """Return the times (K,) [s] at which own ship must be known."""
        return self.tracker.sectors.span(plots)

    def check(self, frame: TrackingFrame, warn: Warn) -> None:
        """Warn of what looks wrong with how plots are told in this frame."""
        config = self.tracker.config
        check_axes(config.sensor, frame, warn)
        check_places(config.sensor, config.scan, frame, warn)

    def track(self, plots: Plots, platform: Platform | None, frame: TrackingFrame) -> Tracks:
        """Follow all contacts through the plots of one message."""
        is_true = frame.tells_true(self.tracker.config.sensor.azimuth_reference)
        local = self._relative(plots, platform) if is_true else plots
        self._take_note(plots, platform, is_true)
        times = self.tracker.sectors.times(local)
        if times is not local.time:
            plots = replace(plots, time=times)  # when own ship may have headed elsewhere
            local = self._relative(plots, platform) if is_true else plots
        return self.tracker.track(local, platform, self.tracker.sectors.beam)

    def _take_note(self, plots: Plots, platform: Platform | None, is_true: bool) -> None:
        """Note what `doubts` judges by; `is_true`: own ship's heading is in the azimuths."""
        self._plots += len(plots)
        if len(plots):
            self._tells_noise = tell_noise(plots, self.tracker.radar.is_polar)
        if not self._has_height:
            self._has_height = bool(np.isfinite((plots.elevation, plots.position[:, 2])).any())
        scan = self.tracker.config.scan
        if scan.assembly == 'message':
            self._parts.note(self.tracker.antenna)
        if scan.assembly == 'message' and not scan.period and not is_true:
            self._untimed.note(plots, platform)

    def _relative(self, plots: Plots, platform: Platform | None) -> Plots:
        """Return plots that are told by true azimuths in the axes of the sensor."""
        mount = self.tracker.config.sensor.mount
        return in_sensor_axes(plots, pose_at(platform, plots.time), mount)

    def doubts(self) -> Iterator[Doubt]:
        """Yield what the plots say against the parameters."""
        yield from doubts(self.tracker, self._plots, self._tells_noise)
        if not self._has_height:
            yield from height_doubts(self._plots)
        yield from self._untimed.doubts()
        yield from self._parts.doubts()

    def to_table(self, previous: Tracks, header: Any) -> Any:
        """Return the track table."""
        config = self.tracker.config
        return from_tracks(
            previous, self.tracker.tracks, header, self._types, output=config.output,
            gate_probability=config.gate.probability,
        )  # fmt: skip

    def to_bodies(self) -> Bodies:
        """Return the confirmed tracks."""
        tracks = self.tracker.tracks
        return to_bodies(take(tracks, tracks.confirmed), self.tracker.config.output)

    def remember(self) -> dict[str, Any]:
        """Return what the tracker knows, for a restart."""
        return remember(self.tracker)

    def recall(self, memory: dict[str, Any]) -> None:
        """Go on from what was remembered; ValueError where it does not fit."""
        recall(self.tracker, memory)

    def follow(self) -> None:
        """Lengthen the trails."""
        tracks, output = self.tracker.tracks, self.tracker.config.output
        self._trails = self._trails.extend(tracks.id, kinematics(tracks, output)[0][:, :3])

    def draw(self, shown: Set[int], header: Any, markers: Any) -> Any:
        """Return the MarkerArray of the tracks."""
        return to_markers(
            self.tracker.tracks, self._trails, shown, header, self._types, lean=self._lean(),
            output=self.tracker.config.output, lead_time=markers.lead_time,
        )  # fmt: skip

    def _lean(self) -> Floats:
        """
        Return the correlation of x and y (T,) in the gates.

        It is that of track and plot together now, which is how the last gate lay too: what makes
        gates long, the azimuth noise of the radar, changes little from look to look.
        """
        bodies = to_bodies(self.tracker.tracks, self.tracker.config.output)
        noise = self.tracker.plot_noise(bodies.state[:, :3])
        total = bodies.covariance[:, :2, :2] + noise[:, :2, :2]
        with np.errstate(invalid='ignore'):
            lean = total[:, 0, 1] / np.sqrt(total[:, 0, 0] * total[:, 1, 1])
        return np.clip(np.nan_to_num(lean), -1.0, 1.0)
