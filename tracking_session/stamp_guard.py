# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which stamps can be right.

One bad stamp must never hurt a track, and a clock that moved must not stop the node. A stamp out
of all proportion is refused; only when several in a row agree with each other has the clock truly
moved, and tracking starts anew. A recording shorter than that proportion is known by its first two
stamps when it is played again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from msg_adapters.bad_message import BadMessage

AGREEING = 3  # stamps in a row that make a new time believed
SLOWEST = 60.0  # s between two scans of any sensor
PATIENCE = 3.0  # intervals between scans that the next one may be late, beyond the threshold


@dataclass
class StampGuard:
    """
    Judge the stamps of one stream of messages.

    Parameters
    ----------
    threshold : float
        A stamp may be so far off without being suspect [s].
    repeats : bool
        Whether messages that follow each other may have one stamp, as parts of one scan.

    """

    threshold: float
    repeats: bool = False
    jumps: int = 0  # times that the clock truly moved
    silences: int = 0  # times that nothing came for longer than a stamp may be off
    _oldest: float | None = None  # stamp accepted first, None if that is not known
    _newest: float | None = None  # stamp accepted last
    _received: float = 0.0  # when, by a clock that never goes back
    _interval: float = 0.0  # between the last two accepted stamps
    _strangers: list[float] = field(default_factory=list)
    _moved: bool = False

    @property
    def is_going_back(self) -> bool:
        """Whether the ROS clock went back, and no stamp has followed it yet."""
        return self._moved

    @property
    def _reach(self) -> float:
        """How far the next stamp may be from the last one."""
        return self.threshold + PATIENCE * self._interval

    def reset(self) -> None:
        """Forget all stamps; the next one is believed."""
        self._oldest, self._newest, self._interval = None, None, 0.0
        self._strangers, self._moved = [], False

    def remember(self) -> dict[str, float | None]:
        """Return the newest stamp and the usual interval, for a restart."""
        return {'newest': self._newest, 'interval': self._interval}

    def recall(self, memory: dict[str, float | None], received: float) -> None:
        """Go on as if the newest stamp had been received then [s]."""
        self.reset()
        self._newest, self._received = memory['newest'], received
        self._interval = memory['interval'] or 0.0

    def clock_moved(self) -> None:
        """Take note that the ROS clock went back: the next stamp that did so too is believed."""
        self._moved = True

    def accept(self, stamp: float, received: float) -> bool:
        """
        Return whether tracking must start anew before this message is used.

        Parameters
        ----------
        stamp : float
            Of the message [s].
        received : float
            When it came, by a clock that never goes back [s].

        Raises
        ------
        BadMessage
            If the message must not be used; says both times.

        """
        if self._newest is None:
            self._take(stamp, received)
            return False
        step = stamp - self._newest
        late = received - self._received  # silence explains a gap
        is_next = step > 0.0 or (self.repeats and step == 0.0)
        if is_next and step <= max(late, 0.0) + self._reach:
            self.silences += step > self._reach
            self._take(stamp, received)
            return False
        is_near = -self.threshold <= step <= 0.0
        if is_near and not (step < 0.0 and self._begins_again(stamp)):
            raise BadMessage(
                'stamp not newer',
                f'header.stamp {stamp:.3f} is not after the last one, {self._newest:.3f}',
            )
        if is_near or self._believe(stamp):
            self.jumps += 1
            interval = stamp - self._strangers[-2] if len(self._strangers) > 1 else 0.0
            self.reset()
            self._take(stamp, received)
            self._interval = interval
            return True
        side = 'ahead of' if step > 0.0 else 'behind'
        raise BadMessage(
            f'stamp {side} time',
            f'header.stamp {stamp:.3f} is {abs(step):.1f} s {side} the last one, '
            f'{self._newest:.3f}; threshold {self.threshold:g} s (time_jump_threshold)',
        )

    def _take(self, stamp: float, received: float) -> None:
        if self._newest is None:
            self._oldest = stamp
        if self._newest is not None and 0.0 < stamp - self._newest <= self._reach:
            self._interval = stamp - self._newest  # a gap that silence explains is none
        self._newest, self._received = stamp, received
        self._strangers, self._moved = [], False

    def _begins_again(self, stamp: float) -> bool:
        """Return whether this stamp follows one that is no newer than the very first."""
        if self._oldest is None:
            return False
        begin = self._strangers[-1] if self._strangers else inf
        if begin <= self._oldest and begin < stamp:
            self._strangers = [begin, stamp]
            return True
        if stamp <= self._oldest:
            self._strangers = [stamp]
            return self._moved
        return False

    def _believe(self, stamp: float) -> bool:
        """Return whether enough strange stamps agree with each other."""
        reach = max(SLOWEST, self.threshold)
        agrees = bool(self._strangers) and 0.0 < stamp - self._strangers[-1] <= reach
        self._strangers = [*self._strangers, stamp] if agrees else [stamp]
        back = self._newest is not None and stamp < self._newest
        return len(self._strangers) >= AGREEING or (self._moved and back)
