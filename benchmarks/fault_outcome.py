# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a fault is, and what it did: how it is played and told."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.fault_stage import Stage
from tracking_core.batches import Floats
from tracking_tools.testing import private_domain

Scan = Callable[[], None]


def _by_stage(stage: Stage) -> Scan:
    return stage.scan


def _node_only(stage: Stage) -> None:
    stage.start_node()


@dataclass(frozen=True)
class Fault:
    """What fails, and on what stage."""

    name: str
    act: Callable[[Stage], None]  # returns when the fault is over
    parameters: tuple[str, ...] = ()  # of the node; {folder} is one of the fault's own
    is_afloat: bool = False
    has_clock: bool = False
    forgets: bool = False  # the tracker is another one, and begins with id 1
    prepare: Callable[[Stage], None] = _node_only
    sends: Callable[[Stage], Scan] = _by_stage  # what the stage itself does each scan


@dataclass(frozen=True)
class Outcome:
    """What one fault did."""

    seen: str
    lapses: int  # scans without tracks of all contacts while it lasted
    scans: int  # ... and after it, until all were held
    seconds: float
    kept: bool  # whether the ids are those of before

    def row(self, fault: str) -> str:
        """Return a row of the table."""
        gone = f'gone for {self.lapses} scans' if self.lapses else 'stay'
        back = f'{self.scans} scans, {self.seconds:.1f} s' if self.scans else 'at once'
        ids = 'kept' if self.kept else 'new'
        return f'| {fault} | {self.seen} | {gone} | {back} | {ids} |'


@contextmanager
def staged(fault: Fault, folder: Path) -> Iterator[tuple[Stage, Scan]]:
    """Yield the stage of a fault, and what it does each scan."""
    folder.mkdir(parents=True, exist_ok=True)
    with private_domain() as domain:
        parameters = [parameter.format(folder=folder) for parameter in fault.parameters]
        stage = Stage(
            domain, folder, *parameters, is_afloat=fault.is_afloat,
            has_clock=fault.has_clock,
        )  # fmt: skip
        with stage.open:
            fault.prepare(stage)
            yield stage, fault.sends(stage)


def play(fault: Fault, folder: Path) -> Outcome:
    """Let a fault act where all contacts are held, and see what becomes of them."""
    with staged(fault, folder) as (stage, scan):
        before = stage.settle(scan)
        fault.act(stage)
        lapses = stage.lapses
        scans, time = stage.until_held(scan)
        kept = before == stage.ids and not fault.forgets
        stage.scans(4, scan)
        return Outcome(stage.seen(), lapses, scans, time, kept)


def repeat(fault: Fault, times: int, folder: Path) -> Floats:
    """Return scans and seconds (times, 2) from the end of a fault until all contacts are held."""
    with staged(fault, folder) as (stage, scan):
        stage.until_held(scan)
        back = []
        for _ in range(times):
            stage.scans(4, scan)
            fault.act(stage)
            back.append(stage.until_held(scan))
    return np.array(back, np.float64)
