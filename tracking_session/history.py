# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which messages were used last, and what is done with plots that come after newer ones?

A tracker's state is a value, so going back is free: the tracker returns to the moment before the
late plots, uses them, and follows the messages after them once more.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import Tracks
from tracking_core.identity import keep_ids
from tracking_core.platform import Platform, StalePlatform
from tracking_core.state import State
from tracking_session.frames import TrackingFrame
from tracking_session.instrument import Instrument

# Messages that are kept, however small the sectors are. Each keeps the tracks of its time alive, a
# kilobyte a track, and all that are newer than a late one are followed once more.
MOST, FEWEST = 512, 64
TRACKS = 200_000  # in all messages together, beyond the fewest
PLOTS = 5  # are kept in as much memory as one track
_PATH = 2.0  # s of own ship beyond a turn and a half: whatever a message needs


@dataclass(frozen=True)
class Step:
    """One message that was used."""

    stamp: float  # [s]
    memory: Any  # of the tracker, before the message
    plots: Any
    platform: Platform | None
    known: State  # of the tracks, after the message


class History:
    """
    The way of one sensor's tracker through the last messages.

    Parameters
    ----------
    instrument : Instrument
        The sensor and its tracker.
    scans : int
        How many scans are kept; 0: none.
    margin : float
        A message may be so much older than the very first one [s], or than the newest one of
        sectors whose turn is not known yet.

    """

    def __init__(self, instrument: Instrument, scans: int, margin: float) -> None:
        self._instrument, self._scans, self._margin = instrument, scans, margin
        self.reset()

    def reset(self) -> None:
        """Forget all messages."""
        self._steps: tuple[Step, ...] = ()
        self._floor = -np.inf  # stamp of the newest message whose place is lost [s]
        self._crowded = -np.inf  # ... and of the newest one that is lost for want of room [s]
        self._oldest = -np.inf  # stamp of what should have a place [s]

    def close(self) -> None:
        """Let nothing more come before what is known now."""
        if self._steps:
            self._floor = self._steps[-1].stamp
        self._steps = ()

    def __len__(self) -> int:
        return len(self._steps)

    def takes(self, stamp: float) -> bool:
        """Return whether a message of this stamp [s] is late and has a place."""
        stamps = [step.stamp for step in self._steps]
        return bool(stamps) and self._floor < stamp < stamps[-1] and stamp not in stamps

    def has_lost(self, stamp: float) -> bool:
        """Return whether a message of this stamp [s] comes too late."""
        return stamp < self._floor

    def lacks_room(self, stamp: float) -> bool:
        """Return whether a message of this stamp [s] is not late but for want of room."""
        return self._oldest < stamp <= self._crowded

    @property
    def span(self) -> float:
        """Return how late a message may be now [s]."""
        return self._steps[-1].stamp - self._floor if self._steps else 0.0

    def step(
        self,
        plots: Any,
        platform: Platform | None,
        frame: TrackingFrame,
        known: State | None = None,
    ) -> Tracks:
        """
        Follow all contacts through one message, and remember how to do so once more.

        `known` is what was known after it, if it is followed once more: tracks keep their ids.
        """
        tracker = self._instrument.tracker
        memory, first = tracker.save(), tracker.state.next_id
        tracks = self._instrument.track(plots, platform, frame)
        if known is not None:
            tracker.state = keep_ids(known, tracker.state, first, tracker.space)
        turn_time = tracker.turn_time
        if turn_time and platform is not None:
            platform = platform.since(plots.stamp - 1.5 * turn_time - _PATH)
        self._add(Step(plots.stamp, memory, plots, platform, tracker.state), turn_time)
        return tracks

    def insert(self, plots: Any, platform: Platform | None, frame: TrackingFrame) -> None:
        """
        Use late plots at their own time.

        Raises
        ------
        BadMessage, StalePlatform
            If they cannot be used, as own ship is not known then; nothing has changed.

        """
        tracker = self._instrument.tracker
        next_id, now, before = tracker.state.next_id, tracker.save(), dict(vars(self))
        later = self._take_after(plots.stamp)
        tracker.restore(later[0].memory)
        tracker.state = replace(tracker.state, next_id=next_id)  # nobody ever had those
        try:
            self.step(plots, platform, frame)
            for step in later:
                self.step(step.plots, step.platform, frame, step.known)
        except (BadMessage, StalePlatform):
            tracker.restore(now)
            vars(self).update(before)
            raise

    def _add(self, step: Step, turn_time: float) -> None:
        """Keep one more message; `turn_time` is that of the tracker [s]."""
        if self._floor == -np.inf:
            self._floor = step.stamp - self._margin
        self._steps += (step,)
        is_known = turn_time < np.inf
        self._oldest = step.stamp - (self._scans * turn_time if is_known else self._margin)
        tracks = len(step.known.tracks) + len(step.plots) // PLOTS
        most = max(FEWEST, min(MOST, TRACKS // (1 + tracks)))
        while len(self._steps) > self._scans:
            first, is_full = self._steps[0].stamp, len(self._steps) > most
            if self._scans and turn_time and first >= self._oldest and not is_full:
                break
            self._floor, self._steps = first, self._steps[1:]
            if is_full:
                self._crowded = first
        if turn_time:  # half a scan apart: stamps of whole turns are no limit, as they are rounded
            self._floor = max(self._floor, self._oldest - 0.5 * turn_time)

    def _take_after(self, stamp: float) -> tuple[Step, ...]:
        """Take out the messages that are newer than this stamp, and return them."""
        later = tuple(step for step in self._steps if step.stamp > stamp)
        self._steps = self._steps[: len(self._steps) - len(later)]
        return later
