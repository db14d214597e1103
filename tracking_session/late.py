# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What is done with plots that come after newer ones.

A tracker's state is a value, so going back is free: the tracker returns to the moment before the
late plots, uses them, and follows the messages after them once more.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import Any

from msg_adapters.bad_message import BadMessage
from tracking_core.batches import State, Tracks
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
        self.history.add(
            Step(plots.stamp, memory, plots, platform, tracker.state), tracker.turn_time
        )
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
        next_id, now, history = tracker.state.next_id, tracker.save(), copy(self.history)
        later = self.history.take_after(plots.stamp)
        tracker.restore(later[0].memory)
        tracker.state = replace(tracker.state, next_id=next_id)  # nobody ever had those
        try:
            self.step(plots, platform, frame)
            for step in later:
                self.step(step.plots, step.platform, frame, step.known)
        except (BadMessage, StalePlatform):
            tracker.restore(now)
            self.history = history
            raise
