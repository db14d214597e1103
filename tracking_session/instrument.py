# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is different from sensor to sensor, as sessions and nodes see it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from typing import Any, Protocol

from msg_adapters.bodies import Bodies
from msg_adapters.reading import Reading
from tracking_core.assembly import TrackerConfig
from tracking_core.batches import Floats, Tracks
from tracking_core.platform import Platform
from tracking_core.space import Space
from tracking_core.state import State
from tracking_session.axes import Warn
from tracking_session.doubts import Doubt
from tracking_session.frames import TrackingFrame


class SensorTracker(Protocol):
    """Tracks of one sensor."""

    @property
    def config(self) -> TrackerConfig:
        """Return the parameters that all trackers have, and its own."""

    @property
    def state(self) -> State:
        """Return all that is remembered of tracks; may be set."""

    @state.setter
    def state(self, state: State) -> None: ...

    @property
    def tracks(self) -> Tracks:
        """Return all tracks."""

    @property
    def turn_time(self) -> float:
        """
        Return the time of one turn of the antenna [s].

        0: it is not known to turn; inf: messages are parts of turns that nobody knows yet.
        """

    @property
    def space(self) -> Space:
        """Return where plots and tracks are: points or angles."""

    @property
    def is_ready(self) -> bool:
        """Return whether tracks may be ordered."""

    @property
    def sensor_position(self) -> tuple[float, float, float]:
        """Return where the sensor was at its last look, tracking frame [m]."""

    def save(self) -> Any:
        """Return what `restore` takes to go back to this moment."""

    def restore(self, memory: Any) -> None:
        """Go back to a moment; the parameters stay."""

    def reset(self) -> None:
        """Forget all but the next id."""

    def reconfigure(self, config: Any) -> None:
        """Go on with other live parameters."""

    def start_track(self, position: Floats, time: float) -> int:
        """Start a confirmed track at a position (2,) or (3,) [m] and a time [s]; return its id."""

    def drop_track(self, track_id: int) -> bool:
        """Delete one track; return whether it was there."""


class Instrument(Protocol):
    """One sensor: its tracker, and what its messages look like on either side."""

    @property
    def topic(self) -> str:
        """Return where its plots come."""

    @property
    def tracker(self) -> SensorTracker:
        """Return what follows the contacts."""

    @property
    def is_mounted(self) -> bool:
        """Return whether the user said where the sensor stands."""

    @property
    def shares_stamps(self) -> bool:
        """Return whether messages are parts of a scan that may have its stamp."""

    @property
    def reach(self) -> float:
        """Return how far a coordinate may be where a user wants a track [m]."""

    def read(self, msg: Any, mapping: Mapping[str, str]) -> Reading[Any]:
        """
        Return the plots of a message; `mapping` is that of the last one, {} before.

        Raises
        ------
        BadMessage
            If it cannot be used.

        """

    def moments(self, plots: Any) -> Floats:
        """Return the times (K,) [s] at which own ship must be known for these plots."""

    def check(self, frame: TrackingFrame, warn: Warn) -> None:
        """Warn of what looks wrong with how plots are told in this frame."""

    def track(self, plots: Any, platform: Platform | None, frame: TrackingFrame) -> Tracks:
        """Follow all contacts through the plots of one message."""

    def doubts(self) -> Iterator[Doubt]:
        """Yield what the plots say against the parameters."""

    def to_table(self, previous: Tracks, header: Any) -> Any:
        """Return the track table; `previous` are the tracks of the last one."""

    def to_bodies(self) -> Bodies:
        """Return where confirmed contacts are, as far as that is known."""

    def remember(self) -> dict[str, Any]:
        """Return what the tracker knows, for a restart: batches, numbers, dictionaries of them."""

    def recall(self, memory: dict[str, Any]) -> None:
        """Go on from what was remembered; ValueError where it does not fit."""

    def follow(self) -> None:
        """Take note of where the tracks are, for drawing; called after every message."""

    def draw(self, shown: Set[int], header: Any, markers: Any) -> Any:
        """Return the MarkerArray; ids that were shown and are gone are deleted."""
