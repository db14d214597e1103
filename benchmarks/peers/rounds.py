# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Every scene once, then every scene again while there is time: so no scene is left out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
import math
from time import monotonic

import numpy as np

from benchmarks.peers.entrants import Entrant, OURS
from benchmarks.peers.menu import Entry
from benchmarks.peers.race import Lap, memory, race
from benchmarks.peers.report import Result
from benchmarks.peers.scenes import Scene
from benchmarks.peers.summary import compare, cost_ratio

MEMORY_SCANS, MEMORY_LIMIT = 8, 10.0  # [s]
STRETCH, STRETCH_SHARE = 10, 0.25  # scans in a row, and part of the limit that they may take
Tick = Callable[[str], object]  # told what is done
Race = tuple[Scene, Mapping[str, Lap], Mapping[str, Lap]]  # scan by scan, and in stretches


def play(
    entries: Mapping[str, Entry], entrants: Mapping[str, Entrant], limit: float, end: float,
    tick: Tick,
) -> dict[str, list[Race]]:  # fmt: skip
    """
    Return the races of each scene.

    Parameters
    ----------
    entries : mapping
        Scenes by name, each with the number of its runs.
    entrants : mapping
        Trackers by name.
    limit : float
        CPU of a tracker in a run [s] after which it gets no more scans.
    end : float
        Time of the monotonic clock [s] from which no second or later run begins.
    tick : callable
        Called after each scan of each tracker.

    """
    races: dict[str, list[Race]] = {name: [] for name in entries}
    for turn in range(max(entry.runs for entry in entries.values())):
        for name, entry in entries.items():
            if turn < entry.runs and (turn == 0 or monotonic() < end):
                scene = entry.make(entry.scans, turn + 1)
                told = partial(_tell, tick, scene.name)
                laps = race(scene, entrants, limit, told)
                again = race(scene, entrants, STRETCH_SHARE * limit, told, STRETCH)
                races[name].append((scene, laps, again))
    return races


def _tell(tick: Tick, title: str, _: str) -> None:
    tick(title)


def sum_up(
    races: list[Race], entrants: Mapping[str, Entrant], limit: float, wanted: int, made: str
) -> Result:
    """Return what the runs of one scene say, and what memory each tracker takes on it."""
    scenes = [scene for scene, _, _ in races]
    rows = {}
    for name, entrant in entrants.items():
        held = memory(scenes[0].first(MEMORY_SCANS), entrant, min(limit, MEMORY_LIMIT))
        mine, ours = ([laps[who] for _, laps, _ in races] for who in (name, OURS))
        row = compare(entrant.title, scenes, mine, ours, held)
        pairs = [(laps[name], laps[OURS]) for _, _, laps in races]
        rows[name] = replace(row, stretched=float(np.mean([cost_ratio(*p) for p in pairs])))
    is_angle = scenes[0].knowledge.axes == 1
    return Result(
        scenes[0].name, scenes[0].contacts, float(np.mean([len(p) for p in scenes[0].plots])),
        'deg' if is_angle else 'm', math.degrees(1.0) if is_angle else 1.0, rows, wanted, made,
    )  # fmt: skip
