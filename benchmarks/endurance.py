# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does the radar node run for a day without growing, slowing down or using an id twice?

``python -m benchmarks.endurance`` sends a day of antenna turns to a live node as fast as it
answers; contacts come and go, false plots among them, and somebody looks at the markers. With
``--crowd`` it is 10,000 contacts for 1000 turns. Prints a line for each hour, or 100 turns, and a
verdict; ends with 1 if memory has grown by more than 2 % after the first, if an id came back, or
if a turn costs more than it did.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
import sys
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np
from visualization_msgs.msg import MarkerArray

from benchmarks.passing_traffic import circling, see, Traffic
from benchmarks.processes import cpu_time, resident
from msg_adapters.table import Columns
from msg_adapters.track_rows import CONFIRMED
from tracking_core.batches import Floats
from tracking_tools.testing import (
    NodeProcess,
    private_domain,
    python_node,
    to_columns,
    TrackerProbe,
)

PERIOD, HOUR = 4.0, 3600.0  # s
ALIVE, STAY, CLUTTER = 40.0, 1200.0, 15.0  # contacts, s each, false plots a turn
CROWD, CROWD_TURNS, SPANS = 10_000, 100, 10  # contacts; turns of a span, and how many
BEGIN = 1_700_000_000.0  # s, stamp of the first turn
GROWTH, DRIFT = 0.02, 0.10  # of memory; of the cost of a turn beside our own, which is noisy
DELETED = 2
MEGABYTE, MILLISECOND = 1e6, 1e-3
MAX_ROWS = 100_000
PATIENCE = 120.0  # s for an answer: the transport takes megabytes slowly on a busy machine


@dataclass
class Watch:
    """What was seen of the node so far, a span of turns at a time."""

    memory: list[int] = field(default_factory=list)  # at the end of each span [bytes]
    cost: list[float] = field(default_factory=list)  # of each span, CPU of the node a turn [s]
    ours: list[float] = field(default_factory=list)  # the same of this process
    dead: set[int] = field(default_factory=set)
    confirmed: int = 0  # at the moment
    newest: int = 0
    again: int = 0  # rows with an id that was deleted before
    _spent: tuple[float, float] = (0.0, 0.0)  # CPU up to the last full span [s]

    def hear(self, table: Columns) -> None:
        """Take note of the ids of one track table."""
        ids = table['id'].tolist()
        self.again += len(self.dead.intersection(ids))
        self.dead.update(table['id'][table['status'] == DELETED].tolist())
        self.newest = max([self.newest, *ids])
        self.confirmed = int((table['status'] == CONFIRMED).sum())

    def span(self, pid: int, turns: int) -> str:
        """Take note of the process after one more span of so many turns; return a line on it."""
        spent = cpu_time(pid), process_time()
        self.memory.append(resident(pid))
        self.cost.append((spent[0] - self._spent[0]) / turns)
        self.ours.append((spent[1] - self._spent[1]) / turns)
        self._spent = spent
        ratio = self.cost[-1] / self.ours[-1]
        return (
            f'{len(self.memory):2d}: {self.memory[-1] / MEGABYTE:6.1f} MB resident, '
            f'{self.cost[-1] / MILLISECOND:5.2f} ms of CPU a turn ({ratio:.2f} of ours), '
            f'{self.confirmed} confirmed, {self.newest} ids'
        )

    @property
    def growth(self) -> float:
        """Share by which memory was ever more than after the first span."""
        return max(self.memory[1:]) / self.memory[0] - 1.0

    @property
    def drift(self) -> float:
        """
        Share by which a turn costs more in the second half than in the first.

        Beside what it costs ourselves, which does not change: a shared machine is slow at times.
        """
        ratio = np.array(self.cost[1:]) / np.array(self.ours[1:])
        early, late = np.array_split(ratio, 2)
        return float(np.median(late) / np.median(early)) - 1.0

    def verdict(self) -> str:
        """Return the figures in words."""
        return (
            f'memory after the first: {self.growth:+.2%} at most; a turn, second half over first: '
            f'{self.drift:+.1%}; ids: {self.newest} given, {self.again} came back'
        )


def endure(
    contacts: Callable[[float], Floats],
    clutter: float,
    spans: int,
    turns: int,
    log: Path,
    *parameters: str,
) -> Watch:
    """
    Send turns to a live node; return what was seen.

    Parameters
    ----------
    contacts : callable
        Returns the complex positions [m] of those that are there at a time [s].
    clutter : float
        False plots a turn.
    spans, turns : int
        So many spans of so many turns.
    log : Path
        Of the node.
    *parameters : str
        Of the node.

    """
    watch, rng, drawn = Watch(), np.random.default_rng(1), []  # type: ignore[var-annotated]
    words = [word for parameter in parameters for word in ('-p', parameter)]
    with (
        private_domain() as domain,
        NodeProcess(python_node('radar_tracker.node', *words), domain, log) as node,
        TrackerProbe(domain, check=node.check) as probe,
    ):
        probe.hear(MarkerArray, 'radar_tracker/markers', drawn)
        probe.wait_for_tracker()
        for turn in range(spans * turns):
            since = turn * PERIOD
            plots = see(contacts(since), clutter, since, PERIOD, rng)
            watch.hear(_ask(probe, plots, BEGIN + since))
            drawn.clear()
            if (turn + 1) % turns == 0:
                print(watch.span(node.process.pid, turns), flush=True)
    return watch


def _ask(probe: TrackerProbe, plots: Any, stamp: float) -> Columns:
    """Send plots, once more if nothing comes; return the track table that answers them."""
    probe.tables.clear()
    probe.diagnostics.clear()
    probe.peer.ask(
        lambda _: probe.send(plots, stamp), lambda: probe.is_answered(stamp), deadline=PATIENCE
    )
    return to_columns(probe.tables[-1], MAX_ROWS)


def day(hours: int, log: Path, turns: int = round(HOUR / PERIOD)) -> Watch:
    """Return what was seen in a day of contacts that come and go, an hour being so many turns."""
    duration = hours * turns * PERIOD
    traffic = Traffic.of(duration, ALIVE, STAY, np.random.default_rng(2))
    return endure(traffic.at, CLUTTER, hours, turns, log)


def crowd(log: Path, count: int = CROWD, spans: int = SPANS, turns: int = CROWD_TURNS) -> Watch:
    """Return what was seen with so many contacts that circle where they are."""
    parameters = (f'max_tracks:={2 * count}', f'max_plots:={2 * count}', 'markers.rate:=0.0')
    return endure(circling(count), 0.0, spans, turns, log, *parameters)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the spans and the verdict."""
    parser = argparse.ArgumentParser(description='A day of turns through the live radar node.')
    parser.add_argument('--hours', type=int, default=24)
    parser.add_argument('--crowd', action='store_true', help='10,000 contacts for 1000 turns')
    given = parser.parse_args(arguments)
    with TemporaryDirectory() as folder:
        log = Path(folder, 'node.log')
        watch = crowd(log) if given.crowd else day(given.hours, log)
    print(watch.verdict())
    return int(watch.growth > GROWTH or watch.drift > DRIFT or watch.again > 0)


if __name__ == '__main__':
    sys.exit(main())
