# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which messages were used last, and what did the tracker know before each of them?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tracking_core.batches import State
from tracking_core.platform import Platform

# Messages that are kept, however small the sectors are. Each keeps the tracks of its time alive, a
# kilobyte a track, and all that are newer than a late one are followed once more.
MOST, FEWEST = 512, 64
TRACKS = 200_000  # in all messages together, beyond the fewest
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
    The last messages.

    Parameters
    ----------
    scans : int
        How many scans are kept; 0: none.
    margin : float
        A message may be so much older than the very first one [s].

    """

    def __init__(self, scans: int, margin: float) -> None:
        self._scans, self._margin = scans, margin
        self.reset()

    def reset(self) -> None:
        """Forget all messages."""
        self._steps: tuple[Step, ...] = ()
        self._floor = -np.inf  # stamp of the newest message whose place is lost [s]
        self._crowded = -np.inf  # ... and of the newest one that is lost for want of room [s]
        self._oldest = -np.inf  # stamp of what should have a place [s]

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

    def add(self, step: Step, turn_time: float) -> None:
        """Keep one more message; `turn_time` is the antenna's [s], 0 if messages are scans."""
        if self._floor == -np.inf:
            self._floor = step.stamp - self._margin
        if turn_time and step.platform is not None:
            path = step.platform.since(step.stamp - 1.5 * turn_time - _PATH)
            step = replace(step, platform=path)
        self._steps += (step,)
        self._oldest = step.stamp - self._scans * turn_time
        most = max(FEWEST, min(MOST, TRACKS // (1 + len(step.known.tracks))))
        while len(self._steps) > self._scans:
            first, is_full = self._steps[0].stamp, len(self._steps) > most
            if self._scans and turn_time and first >= self._oldest and not is_full:
                break
            self._floor, self._steps = first, self._steps[1:]
            if is_full:
                self._crowded = first

    def take_after(self, stamp: float) -> tuple[Step, ...]:
        """Take out the messages that are newer than this stamp, and return them."""
        later = tuple(step for step in self._steps if step.stamp > stamp)
        self._steps = self._steps[: len(self._steps) - len(later)]
        return later

    def close(self) -> None:
        """Let nothing more come before what is known now."""
        if self._steps:
            self._floor = self._steps[-1].stamp
        self._steps = ()
