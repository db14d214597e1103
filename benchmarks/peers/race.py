# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
All trackers on one scene, scan by scan, so that a busy machine is busy for all.

Who comes after a tracker of large data finds none of his own in the caches: in each scan the order
is another one. In stretches of some scans each finds its own, but for the first of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import process_time
import tracemalloc

import numpy as np

from benchmarks.peers.entrants import Entrant, Runner
from benchmarks.peers.scenes import Scene
from tracking_core.batches import Floats, Ints

Rows = list[tuple[Ints, Floats]]


@dataclass
class Lap:
    """What one tracker said of a scene, and what it cost."""

    rows: Rows = field(default_factory=list)  # ids (T,), positions (T, d) in each scan
    cpu: list[float] = field(default_factory=list)  # of each scan [s]

    @property
    def scans(self) -> int:
        """How many it did before its time was over."""
        return len(self.rows)


def race(
    scene: Scene,
    entrants: Mapping[str, Entrant],
    limit: float,
    tick: Callable[[str], object] = lambda name: None,
    stretch: int = 1,
) -> dict[str, Lap]:
    """
    Return what each tracker made of the scene.

    Parameters
    ----------
    scene : Scene
        The same for all.
    entrants : mapping
        By name.
    limit : float
        Who has used so much CPU [s] gets no more scans.
    tick : callable
        Told the name of the tracker after each scan.
    stretch : int
        Scans that each does in a row before the next tracker does them.

    """
    runners = {name: entrant.make(scene.knowledge) for name, entrant in entrants.items()}
    laps, names, rng = {name: Lap() for name in runners}, list(runners), np.random.default_rng(1)
    scans = list(zip(scene.times.tolist(), scene.plots, strict=True))
    for first in range(0, len(scans), stretch):
        for name in (names[k] for k in rng.permutation(len(names))):
            for time, plots in scans[first : first + stretch]:
                if sum(laps[name].cpu) < limit:
                    _step(runners[name], time, plots, laps[name])
                tick(name)
    return laps


def _step(runner: Runner, time: float, plots: Floats, lap: Lap) -> None:
    begin = process_time()
    said = runner.step(time, plots)
    lap.cpu.append(process_time() - begin)
    lap.rows.append(said)


@dataclass(frozen=True)
class Memory:
    """What a tracker holds in memory."""

    held: float  # after the last scan, for each track [bytes]
    peak: float  # at most [bytes]


def memory(scene: Scene, entrant: Entrant, limit: float) -> Memory:
    """
    Return the memory that a tracker takes on a scene, its libraries not counted.

    It gets no more scans once it has tracks and has used so much CPU [s].
    """
    warm = entrant.make(scene.knowledge)
    for k in range(2):  # imports, tables and compiled code are not the tracks'
        warm.step(float(scene.times[k]), scene.plots[k])
    del warm
    tracemalloc.start()
    begin, tracks = process_time(), 0
    runner = entrant.make(scene.knowledge)
    for time, plots in zip(scene.times.tolist(), scene.plots, strict=True):
        tracks = len(runner.step(time, plots)[0])
        if tracks and process_time() - begin > limit:
            break
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return Memory(held / max(tracks, 1), float(peak))


def typical(cpu: list[float], settling: int) -> float:
    """Return the median CPU of a scan [ms] once the tracks are there; NaN before."""
    settled = cpu[settling:]
    return 1e3 * float(np.median(settled)) if settled else float('nan')
