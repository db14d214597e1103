# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How old are the tracks when plots come ten times as fast as the radar node can use them?

``python -m benchmarks.overload`` measures what a live node can do with messages of 3000 plots,
sends ten times as many, and prints how old the answers were, what share was shed and lost, and by
how much memory grew; with `max_delay` 0, which is what a plain subscription does, and bounded.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
import sys
from tempfile import TemporaryDirectory
from time import monotonic

import numpy as np

from benchmarks.processes import resident
from msg_adapters.message_types import seconds
from msg_adapters.table import Columns
from tracking_tools.testing import NodeProcess, private_domain, python_node, TrackerProbe

PLOTS, ALONE = 3000, 20  # in a message; messages that are answered one by one
FACTOR = 10.0
FAREWELL = 20.0  # s for the answer to the last message
MEGABYTE = 1e6


@dataclass(frozen=True)
class Outcome:
    """What a node did with more than it can."""

    rate: float  # messages a second
    capacity: float  # ... that it can use
    ages: np.ndarray  # of the plots when their tracks came [s]
    shed: float  # share of the messages
    lost: float
    growth: tuple[float, float]  # of the resident memory, first and second half [MB]

    def row(self, name: str) -> str:
        """Return a row of a Markdown table."""
        middle, high = np.quantile(self.ages, [0.5, 0.95])
        first, later = self.growth
        return (
            f'| {name} | {self.capacity:.1f} | {self.rate:.1f} | {middle:.2f} | {high:.2f} '
            f'| {self.ages.max():.2f} | {self.shed:.0%} | {self.lost:.0%} '
            f'| {first:+.1f}, then {later:+.1f} |'
        )


HEAD = (
    '| `max_delay` [s] | can use [1/s] | sent [1/s] | age, median [s] | 95 % | most | shed | lost '
    '| memory [MB] |\n' + '|---' * 9 + '|'
)


def noise(rng: np.random.Generator) -> Columns:
    """Return false plots."""
    columns = {'range': rng.uniform(1e3, 3e5, PLOTS), 'azimuth': rng.uniform(-3.1, 3.1, PLOTS)}
    return {name: values.astype(np.float32) for name, values in columns.items()}


def overload(max_delay: float, duration: float, log: Path) -> Outcome:
    """Send ten times what a node can use for so long [s]."""
    command = python_node('radar_tracker.node', '-p', f'max_delay:={max_delay}')
    with (
        private_domain() as domain,
        NodeProcess(command, domain, log) as node,
        TrackerProbe(domain, check=node.check) as probe,
    ):
        probe.meet()
        scans = [noise(np.random.default_rng(seed)) for seed in range(ALONE)]
        begin = monotonic()
        for number, columns in enumerate(scans, 1):
            probe.stamp = probe.stamp + 0.1
            probe.peer.ask(
                lambda _, columns=columns: probe.send(columns, probe.stamp),
                lambda: probe.is_answered(probe.stamp),
                f'scan {number}',
            )
        capacity = ALONE / (monotonic() - begin)
        return _flood(probe, node.process.pid, scans, capacity, duration)


def _flood(
    probe: TrackerProbe, pid: int, scans: Sequence[Columns], capacity: float, duration: float
) -> Outcome:
    before, memory = _counts(probe), [resident(pid)]
    sent, ages, heard = {}, [], len(probe.tables)
    first, begin, period = probe.stamp + 0.1, monotonic(), 1.0 / (FACTOR * capacity)
    while (now := monotonic() - begin) < duration:
        stamp = round(first + now, 6)
        probe.send(scans[len(sent) % ALONE], stamp)
        sent[stamp] = begin + now
        probe.peer.spin(lambda: False, max(begin + len(sent) * period - monotonic(), 1e-4))
        heard = _hear(probe, heard, sent, ages)
        if now > 0.5 * duration and len(memory) == 1:
            memory.append(resident(pid))
    probe.spin_until(lambda: probe.is_answered(stamp), 'the newest plots', FAREWELL)
    _hear(probe, heard, sent, ages)
    growth = np.diff([*memory, resident(pid)]) / MEGABYTE
    total = len(sent)
    probe.spin_until(lambda: sum(_counts(probe)) - sum(before) >= total, 'all counted')
    _, shed, lost = np.subtract(_counts(probe), before)
    return Outcome(
        total / duration, capacity, np.array(ages), shed / total, lost / total, tuple(growth)
    )


def _hear(probe: TrackerProbe, heard: int, sent: dict[float, float], ages: list[float]) -> int:
    """Take down how old the plots of new track tables are; return how many tables there are."""
    now = monotonic()
    for table in probe.tables[heard:]:
        since = sent.get(round(seconds(table.header.stamp), 6))
        if since is not None:
            ages.append(now - since)
    return len(probe.tables)


def _counts(probe: TrackerProbe) -> tuple[int, int, int]:
    """Return messages that were used, shed and lost, by the last diagnostics."""
    came, shed, lost = (
        int(probe.diagnosed(f'plots {what}') or 0) for what in ('messages', 'shed', 'lost')
    )
    return came - shed, shed, lost


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description='More plots than the radar node can use.')
    parser.add_argument('--seconds', type=float, default=60.0, help='for each row')
    parser.add_argument('--max-delay', type=float, nargs='*', default=[0.0, 1.0, 0.3])
    given = parser.parse_args(arguments)
    print(HEAD, flush=True)
    with TemporaryDirectory() as folder:
        for max_delay in given.max_delay:
            outcome = overload(max_delay, given.seconds, Path(folder, 'node.log'))
            print(outcome.row(f'{max_delay:g}'), flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
