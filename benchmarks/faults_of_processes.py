# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of processes: killed, late, or one too many."""

from __future__ import annotations

from functools import partial

from benchmarks.fault_outcome import Fault, Scan
from benchmarks.fault_stage import PERIOD, Stage

DEAD = 4  # scans until somebody has started it again
UNKNOWN = 12  # ... of own ship, longer than its timeout of 2 s
BOTH = 16  # scans with two publishers
SILENCE = 28  # scans without any, longer than the 5 s after which the node explains itself


def _source(stage: Stage, what: str) -> None:
    stage.start_node()
    stage.start_source(what)


def _idle(stage: Stage) -> Scan:
    return stage.idle


def _plots(stage: Stage) -> Scan:
    return stage.plots


def kill_source(stage: Stage, what: str, scans: int = DEAD) -> None:
    """Kill who publishes plots or odometry; somebody starts it again."""
    stage.kill(stage.nodes[-1])
    stage.scans(scans, stage.idle if what == 'plots' else stage.plots)
    stage.start_source(what)


def kill_node(stage: Stage) -> None:
    """Kill the tracker and start it again."""
    stage.kill(stage.nodes[-1])
    stage.idle()  # its last tracks come in
    stage.probe.tables.clear()
    stage.start_node()


def start_late(stage: Stage) -> None:
    """End the tracker; another is started while the radar has long been there."""
    stage.nodes[-1].stop()
    stage.scans(DEAD)
    stage.probe.tables.clear()
    stage.start_node()


def say_nothing(stage: Stage) -> None:
    """Let the radar be silent."""
    stage.scans(SILENCE, stage.idle)


def add_source(stage: Stage) -> None:
    """Let a second process publish the same plots, a recording perhaps."""
    other = stage.start_source('plots')
    stage.scans(2 * BOTH)
    other.stop()


def add_node(stage: Stage) -> None:
    """Start a second tracker on the same topics, under another name, and end it again."""
    other = stage.start_node('-r', '__node:=second_tracker')
    stage.scans(2 * BOTH)
    other.stop()


KILL_PLOTS = Fault(
    'radar killed, started again after 1 s', partial(kill_source, what='plots'),
    prepare=partial(_source, what='plots'), sends=_idle,
)  # fmt: skip
KILL_NODE = Fault('tracker killed, started again at once', kill_node, forgets=True)
KILL_SHIP = Fault(
    f'own ship killed, started again after {UNKNOWN * PERIOD:g} s',
    partial(kill_source, what='ownship', scans=UNKNOWN), is_afloat=True,
    prepare=partial(_source, what='ownship'), sends=_plots,
)  # fmt: skip
KILLS = (KILL_PLOTS, KILL_NODE, KILL_SHIP)
PROCESS_FAULTS = (
    *KILLS,
    Fault(
        'tracker killed, started again with its snapshot',
        kill_node,
        ('snapshot.file:={folder}/tracks', 'snapshot.period:=1.0'),
    ),
    Fault('tracker started late, the radar has long been there', start_late, forgets=True),
    Fault(f'radar silent for {SILENCE * PERIOD:g} s', say_nothing),
    Fault('a second publisher sends the same plots', add_source),
    Fault('a second tracker on the same topics', add_node),
)
