# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does the radar node run for a day without growing, slowing down or using an id twice?

``python -m benchmarks.endurance`` sends a day of antenna turns to a live node as fast as it
answers; contacts come and go, false plots among them, and somebody looks at the markers. With
``--crowd`` it is 10,000 contacts for 1000 turns. Prints a line for each hour, or 100 turns, and a
verdict; ends with 1 if memory has grown by more than 2 % after the first (a crowd's, whose arrays
are of megabytes that come and go: 2 % from half to half), if an id came back, or if a turn costs
more than it did.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
import os
from pathlib import Path
import sys
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from visualization_msgs.msg import MarkerArray

from benchmarks.node_watch import Watch
from benchmarks.passing_traffic import circling, see, Traffic
from benchmarks.processes import resident
from msg_adapters.message_types import seconds
from msg_adapters.table import Columns
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
GROWTH, CROWDED, DRIFT = 0.02, 0.10, 0.10  # of memory, its peaks in a crowd; cost of a turn
MAX_ROWS = 100_000
PATIENCE = 120.0  # s for an answer: the transport takes megabytes slowly on a busy machine
AGAIN = 20.0  # s until a turn is sent once more; a turn that comes twice is two for the tracker
LATER = 0.01  # s by which a turn that is sent once more is later


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
            watch.hear(_ask(probe, plots, BEGIN + since), resident(node.process.pid))
            drawn.clear()
            if (turn + 1) % turns == 0:
                print(watch.span(node.process.pid, turns), flush=True)
    return watch


def _ask(probe: TrackerProbe, plots: Any, stamp: float) -> Columns:
    """
    Send plots, a little later once more if nothing comes; return the table that answers them.

    Where the answer was lost and not the question, the same stamp would be refused as a copy.
    """
    probe.tables.clear()
    probe.diagnostics.clear()
    probe.peer.ask(
        lambda attempt: probe.send(plots, stamp + LATER * attempt),
        lambda: probe.tables and seconds(probe.tables[-1].header.stamp) > stamp - LATER / 2,
        again=AGAIN,
        deadline=PATIENCE,
    )
    return to_columns(probe.tables[-1], MAX_ROWS)


def day(hours: int, log: Path, turns: int = round(HOUR / PERIOD)) -> Watch:
    """Return what was seen in a day of contacts that come and go, an hour being so many turns."""
    duration = hours * turns * PERIOD
    traffic = Traffic.of(duration, ALIVE, STAY, np.random.default_rng(2))
    return endure(traffic.at, CLUTTER, hours, turns, log)


def crowd(log: Path, count: int = CROWD, spans: int = SPANS, turns: int = CROWD_TURNS) -> Watch:
    """Return what was seen with so many contacts that circle where they are."""
    os.environ.setdefault('FASTDDS_BUILTIN_TRANSPORTS', 'LARGE_DATA')  # tables are of 4 MB
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
    has_grown = watch.growth > (CROWDED if given.crowd else GROWTH) or watch.trend > GROWTH
    return int(has_grown or watch.drift > DRIFT or watch.again > 0)


if __name__ == '__main__':
    sys.exit(main())
