# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What is done with each message, without a ROS graph and whatever the sensor.

The node hands over what it receives and publishes what comes back, as a replay does with a bag.
Whatever a message contains, the worst that happens is a refusal, counted and said. What a user
orders is in ``orders.py``.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import frame_name, frame_of, MessageTypes
from msg_adapters.ownship import to_platform
from msg_adapters.reading import Reading
from tracking_core.batches import Tracks
from tracking_core.platform import StalePlatform
from tracking_session.frames import TrackingFrame
from tracking_session.heading_guard import HeadingGuard
from tracking_session.history import History
from tracking_session.input_count import InputCount
from tracking_session.instrument import Instrument
from tracking_session.ledger import Ledger, Log
from tracking_session.node_config import NodeConfig
from tracking_session.stamp_guard import StampGuard
from tracking_session.whereabouts import Transforms, Whereabouts


class Session:
    """
    One sensor from the first message on.

    Parameters
    ----------
    instrument : Instrument
        The sensor and its tracker.
    node_config : NodeConfig
        Of the messages.
    types : MessageTypes
        Classes of the messages that come back.
    log : Log
        Takes what a user must know.

    """

    def __init__(
        self, instrument: Instrument, node_config: NodeConfig, types: MessageTypes, log: Log
    ) -> None:
        self.instrument = instrument
        self.ledger = Ledger(f'{instrument.topic} ownship acquire cancel', log.warning)
        self.guard = StampGuard(node_config.time_jump_threshold, instrument.shares_stamps)
        self.whereabouts, self._heading = Whereabouts(node_config), HeadingGuard()
        self._history = History(instrument, node_config.scan.late, node_config.time_jump_threshold)
        self._node_config, self.types, self.log = node_config, types, log
        self.published = instrument.tracker.tracks
        self._forget()

    def _forget(self) -> None:
        """Be as after a start, but for the tracks that must be reported as deleted."""
        for known in (self._history, self.guard, self.whereabouts, self._heading):
            known.reset()
        name = frame_name(self._node_config.tracking_frame)
        self.frame = TrackingFrame(name, self.instrument.is_mounted, self.log.info)
        self.frame.by_tree = self.whereabouts.transforms is not None
        self.stamp: Any = None  # of the last plots that were used
        self.mapping: dict[str, str] = {}

    def use_transforms(self, transforms: Transforms) -> None:
        """Take the place of the sensor from these; ValueError if a mount is set too."""
        if self.instrument.is_mounted:
            raise ValueError('use_tf is true and sensor.mount is set: tf2 knows the mount')
        self.whereabouts.transforms, self.frame.by_tree = transforms, True

    @property
    def counts(self) -> dict[str, InputCount]:
        """What happened to the messages of each topic."""
        return self.ledger.counts

    @property
    def tracks(self) -> Tracks:
        """All tracks as of the last message."""
        return self.instrument.tracker.tracks

    def reset(self) -> None:
        """Start anew: tracks, clock, frames and own ship are forgotten."""
        self.instrument.tracker.reset()
        self._forget()

    def header(self) -> Any:
        """Return a header with the stamp of the last plots, in the tracking frame."""
        stamp = self.types.Time(sec=self.stamp.sec, nanosec=self.stamp.nanosec)
        return self.types.Header(stamp=stamp, frame_id=self.frame.name)

    def plots(self, msg: Any, received: float, patience: float = 0.0) -> Any | None:
        """
        Return the track table after this message, None if it was refused, came late, or waits.

        Late plots and parts of a scan show in a later table. `NotYet` passes.

        Parameters
        ----------
        msg : PointCloud2, or another type on the menu of ``kinds``
            Plots.
        received : float
            When it came, by a clock that never goes back [s].
        patience : float
            Plots may wait so long for where their sensor was [s].

        """
        try:
            return self._follow(msg, received, patience)
        except (BadMessage, StalePlatform) as error:
            self.ledger.refuse(self.instrument.topic, error.reason, error)
        return None

    def _follow(self, msg: Any, received: float, patience: float) -> Any:
        reading = self.instrument.read(msg, self.mapping)
        plots = reading.plots
        frame = self.frame.copy()  # a message that cannot be used decides nothing
        frame.check_plots(plots.frame, reading.is_polar)
        if len(plots):
            self.instrument.check(frame, self.ledger.warn)
        platform = self.whereabouts.covering(self.instrument.moments(plots), frame, patience)
        self.frame = frame
        if self.whereabouts.has_leapt():
            self._start_anew('the sensor is elsewhere')
        if self._history.takes(plots.stamp) and not self.guard.is_going_back:
            self._history.insert(plots, platform, self.frame)
            self._use(reading)
            self.counts[self.instrument.topic].late_used += 1
            return None
        if self._accept(plots.stamp, received):
            self._start_anew(f'time moved to {plots.stamp:.3f} (a recording that began anew?)')
        before = self.instrument.tracker.state
        tracks = self._history.step(plots, platform, self.frame)
        self._tell_silent()
        self.ledger.doubt(self.instrument.doubts())
        self._use(reading)
        self.stamp = msg.header.stamp
        if self.instrument.tracker.state is before:  # a part of a scan that is not over
            return None
        last, self.published = self.published, tracks
        return self.instrument.to_table(last, self.header())

    def _accept(self, stamp: float, received: float) -> bool:
        """Return whether tracking must start anew; raises BadMessage, and counts what is late."""
        try:
            return self.guard.accept(stamp, received)
        except BadMessage:
            history, topic = self._history, self.instrument.topic
            self.counts[topic].late_dropped += history.has_lost(stamp)
            if history.lacks_room(stamp):
                kept = f'no more messages are kept than those of the last {history.span:.1f} s'
                self.ledger.warn('no room', f'{topic} within scan.late are dropped: {kept}')
            raise

    def _start_anew(self, why: str) -> None:
        self.log.warning(f'{why}: tracking starts anew')
        self._history.reset()
        self.instrument.tracker.reset()

    def _tell_silent(self) -> None:
        """Say what a pause has ended; all, again and again, where it is set too short."""
        tracker = self.instrument.tracker
        if silent := tracker.state.report.silent:
            what = f'{silent} tracks and first plots end: no look for more than'
            self.ledger.warn('pause', f'{what} {tracker.config.longest_pause:g} s (longest_pause)')

    def _use(self, reading: Reading[Any]) -> None:
        """Count the rows of a message that is accepted, and say once which fields are used."""
        rows = len(reading.plots)
        self.ledger.use(self.instrument.topic, rows, reading.dropped, reading.doubtful)
        if rows and not self.mapping:
            used = ', '.join(f'{ours}: {theirs}' for ours, theirs in reading.mapping.items())
            self.log.info(f'fields of the {self.instrument.topic} in use: {used}')
            if reading.note:
                self.log.warning(reading.note)
            self.mapping = reading.mapping

    def ownship(self, msg: Any, received: float) -> None:
        """Take one odometry of the platform."""
        try:
            sample = to_platform(msg, partial(self.ledger.unused, 'ownship'))
            appeared = self.frame.check_ownship(frame_of(msg), float(sample.time[0]))
            if self.whereabouts.take(sample, received) or appeared:
                self._start_anew('own ship appeared' if appeared else 'own ship is elsewhere')
            self.ledger.doubt(self.whereabouts.doubts())
            self._heading.take(sample, self.ledger.fail)
        except BadMessage as error:
            self.ledger.refuse('ownship', error.reason, error)

    def settle(self) -> None:
        """Let late plots undo nothing of what there is now: a user ordered it."""
        self._history.close()
