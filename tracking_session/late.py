# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What is done with plots that come after newer ones.

A tracker's state is a value, so going back is free: the tracker returns to the moment before the
late plots, uses them, and follows the messages after them once more.
"""

from __future__ import annotations

from copy import copy
from typing import Any

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import Tracks
from tracking_core.identity import keep_ids
from tracking_core.platform import Platform, StalePlatform
from tracking_session.frames import TrackingFrame
from tracking_session.history import History, Step
from tracking_session.instrument import Instrument


class Follower:
    """
    One sensor's tracker, and its way through the last messages.

    Parameters
    ----------
    instrument : Instrument
        The sensor and its tracker.
    history : History
        Empty.

    """

    def __init__(self, instrument: Instrument, history: History) -> None:
        self._instrument, self.history = instrument, history

    def step(self, plots: Any, platform: Platform | None, frame: TrackingFrame) -> Tracks:
        """Follow all contacts through one message, and remember how to do so once more."""
        tracker = self._instrument.tracker
        step = Step(plots.stamp, tracker.save(), plots, platform)
        tracks = self._instrument.track(plots, platform, frame)
        self.history.add(step, tracker.turn_time)
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
        before, now, history = tracker.state, tracker.save(), copy(self.history)
        later = self.history.take_after(plots.stamp)
        tracker.restore(later[0].memory)
        first = tracker.state.next_id
        try:
            self.step(plots, platform, frame)
            for step in later:
                self.step(step.plots, step.platform, frame)
        except (BadMessage, StalePlatform):
            tracker.restore(now)
            self.history = history
            raise
        tracker.state = keep_ids(before, tracker.state, first, tracker.space)
