# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does a node grow, slow down, or use an id twice? What is seen of it from outside."""

from __future__ import annotations

from dataclasses import dataclass, field
from time import process_time

import numpy as np

from benchmarks.processes import cpu_time
from msg_adapters.table import Columns
from msg_adapters.track_rows import CONFIRMED
from tracking_core.batches import Floats

DELETED = 2
MEGABYTE, MILLISECOND = 1e6, 1e-3


@dataclass
class Watch:
    """What was seen of the node so far, a span of turns at a time."""

    memory: list[int] = field(default_factory=list)  # at the end of each span [bytes]
    usual: list[float] = field(default_factory=list)  # median of each span's turns [bytes]
    cost: list[float] = field(default_factory=list)  # of each span, CPU of the node a turn [s]
    ours: list[float] = field(default_factory=list)  # the same of this process
    dead: set[int] = field(default_factory=set)
    confirmed: int = 0  # at the moment
    newest: int = 0
    again: int = 0  # rows with an id that was deleted before
    _spent: tuple[float, float] = (0.0, 0.0)  # CPU up to the last full span [s]
    _resident: list[int] = field(default_factory=list)  # after each turn of this span [bytes]

    def hear(self, table: Columns, memory: int) -> None:
        """
        Take note of one turn.

        Parameters
        ----------
        table : dict of (T,) arrays
            The tracks.
        memory : int
            Resident memory of the node [bytes]. Buffers of messages come and go in it, by several
            percent in a crowd: one look a span would say little.

        """
        self._resident.append(memory)
        ids = table['id'].tolist()
        self.again += len(self.dead.intersection(ids))
        self.dead.update(table['id'][table['status'] == DELETED].tolist())
        self.newest = max([self.newest, *ids])
        self.confirmed = int((table['status'] == CONFIRMED).sum())

    def span(self, pid: int, turns: int) -> str:
        """Take note of the process after one more span of so many turns; return a line on it."""
        spent = cpu_time(pid), process_time()
        self.memory.append(self._resident[-1])
        self.usual.append(float(np.median(self._resident)))
        self._resident.clear()
        self.cost.append((spent[0] - self._spent[0]) / turns)
        self.ours.append((spent[1] - self._spent[1]) / turns)
        self._spent = spent
        ratio = self.cost[-1] / self.ours[-1]
        return (
            f'{len(self.memory):2d}: {self.usual[-1] / MEGABYTE:6.1f} MB resident, '
            f'{self.cost[-1] / MILLISECOND:5.2f} ms of CPU a turn ({ratio:.2f} of ours), '
            f'{self.confirmed} confirmed, {self.newest} ids'
        )

    @property
    def growth(self) -> float:
        """Share by which memory was ever more than after the first span."""
        return max(self.memory[1:]) / self.memory[0] - 1.0

    @property
    def trend(self) -> float:
        """Share by which memory is usually more in the second half than in the first."""
        return _later(np.array(self.usual[1:], np.float64))

    @property
    def drift(self) -> float:
        """
        Share by which a turn costs more in the second half than in the first.

        By itself or beside what it costs ourselves, whichever is less: on a shared machine both
        are noisy, but a node that slows down would show in either.
        """
        cost = np.array(self.cost[1:])
        return min(_later(cost), _later(cost / np.array(self.ours[1:])))

    def verdict(self) -> str:
        """Return the figures in words."""
        return (
            f'memory after the first: {self.growth:+.2%} at most, second half over first '
            f'{self.trend:+.2%}; cost of a turn, the same: {self.drift:+.1%}; '
            f'ids: {self.newest} given, {self.again} came back'
        )


def _later(values: Floats) -> float:
    """Return by what share the median of the second half is above that of the first."""
    early, late = np.array_split(values, 2)
    return float(np.median(late) / np.median(early)) - 1.0
