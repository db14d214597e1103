# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a user is told about a replay, while it runs and at its end."""

from __future__ import annotations

from dataclasses import dataclass, field
import sys

from tqdm import tqdm

from msg_adapters.message_types import NANOSECONDS
from tracking_core.batches import Tracks
from tracking_session.input_count import InputCount


@dataclass(frozen=True)
class Console:
    """A log for people: lines on the standard error, above the progress bar."""

    quiet: bool

    def info(self, message: str, /) -> None:
        """Say what happens."""
        if not self.quiet:
            tqdm.write(message, file=sys.stderr)

    def warning(self, message: str, /) -> None:
        """Say what is wrong."""
        if not self.quiet:
            tqdm.write(f'warning: {message}', file=sys.stderr)


@dataclass
class Summary:
    """What a replay did."""

    plots: InputCount  # of the messages and their rows
    tables: int = 0  # written
    confirmed: set[int] = field(default_factory=set)  # ids
    step_times: list[float] = field(default_factory=list)  # from message to table [s]
    wall_time: float = 0.0  # [s]
    _first: int | None = None  # recorded [ns]
    _last: int = 0

    def add(self, tracks: Tracks, received: int) -> None:
        """Count one table and the time [ns] at which its plots were recorded."""
        self.tables += 1
        self.confirmed.update(tracks.id[tracks.confirmed].tolist())
        self._first = received if self._first is None else self._first
        self._last = received

    @property
    def duration(self) -> float:
        """Recorded time from the first to the last message that was used [s]."""
        return 0.0 if self._first is None else (self._last - self._first) / NANOSECONDS

    @property
    def unused(self) -> str:
        """Why no message could be used; '' if one was."""
        if self.tables:
            return ''
        why = ', '.join(f'{reason} ({n})' for reason, n in self.plots.refused.items())
        return why or ('no scan is over' if self.plots.messages else 'there is none')

    def __str__(self) -> str:
        speed = self.duration / self.wall_time if self.wall_time else 0.0
        late, in_vain = self.plots.late_used, self.plots.in_vain
        lines = [
            f'messages: {self.plots.messages}, used: {self.tables}, plots used: {self.plots.rows}',
            *([f'used late: {late} messages'] if late else []),
            *([f'waited in vain for own ship: {in_vain} messages'] if in_vain else []),
            *(f'refused: {n} messages, {why}' for why, n in sorted(self.plots.refused.items())),
            *(f'dropped: {n} plots, {why}' for why, n in sorted(self.plots.dropped.items())),
            f'tracks confirmed: {len(self.confirmed)}',
            f'{self.duration:.1f} s of recording in {self.wall_time:.1f} s: '
            f'{speed:.0f} times real time',
        ]
        return '\n'.join(lines)
