# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which messages were used last, and what did the tracker know before each of them?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tracking_core.batches import State
from tracking_core.platform import Platform

MOST = 64  # messages, however small the sectors are: each keeps the tracks of its time alive


@dataclass(frozen=True)
class Step:
    """One message that was used."""

    stamp: float  # [s]
    memory: Any  # of the tracker, before the message
    plots: Any
    platform: Platform | None
    known: State | None  # of the tracks, after the message


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
        self._steps: tuple[Step, ...] = ()
        self._floor = -np.inf  # stamp of the newest message whose place is lost [s]

    def takes(self, stamp: float) -> bool:
        """Return whether a message of this stamp [s] is late and has a place."""
        stamps = [step.stamp for step in self._steps]
        return bool(stamps) and self._floor < stamp < stamps[-1] and stamp not in stamps

    def has_lost(self, stamp: float) -> bool:
        """Return whether a message of this stamp [s] comes too late."""
        return stamp < self._floor

    def add(self, step: Step, turn_time: float) -> None:
        """Keep one more message; `turn_time` is the antenna's [s], 0 if messages are scans."""
        if self._floor == -np.inf:
            self._floor = step.stamp - self._margin
        self._steps += (step,)
        oldest = step.stamp - self._scans * turn_time
        while len(self._steps) > self._scans and (
            self._steps[0].stamp < oldest
            or not (self._scans and turn_time)
            or len(self._steps) > MOST
        ):
            self._floor, self._steps = self._steps[0].stamp, self._steps[1:]

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

    def reset(self) -> None:
        """Forget all messages."""
        self._steps, self._floor = (), -np.inf
