# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do several runs of a scene say of each tracker, beside ours on the same plots?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

import numpy as np

from benchmarks.peers.judge import judge, SETTLING, Verdict
from benchmarks.peers.race import Lap, Memory, typical
from benchmarks.peers.scenes import Scene

ACCURACY = {'gospa': -1.0, 'held': 1.0, 'rmse': -1.0, 'switches': -1.0}  # which sign is better
LEAST = SETTLING + 3  # scans without which nothing can be said


@dataclass(frozen=True)
class Figure:
    """A mean over runs, and how far it is from ours in the same runs."""

    mean: float
    margin: float  # theirs less ours
    error: float  # standard error of the margin; NaN for a single run

    def is_better(self, sense: float) -> bool:
        """Whether theirs is better, and not by chance: two standard errors, 2 % of one run."""
        sure = 0.02 * abs(self.mean) if math.isnan(self.error) else 2.0 * self.error
        return sense * self.margin > max(sure, 1e-9 * abs(self.mean))


@dataclass(frozen=True)
class Row:
    """One tracker on one scene."""

    title: str
    scans: int  # done, the fewest of all runs
    wanted: int
    runs: int
    figures: dict[str, Figure]  # by the fields of a verdict
    ratio: float  # CPU by that of ours, mean over the runs
    last: float  # CPU of its last scan [ms]
    memory: Memory | None
    stretched: float = math.nan  # ratio as above, of scans in a row

    @property
    def finished(self) -> bool:
        """Whether every scan was done within the time limit."""
        return self.scans == self.wanted


def compare(
    title: str, scenes: Sequence[Scene], laps: Sequence[Lap], ours: Sequence[Lap],
    memory: Memory | None = None,
) -> Row:  # fmt: skip
    """Return what the runs of one tracker say beside ours, over the scans that both did."""
    done = min(lap.scans for lap in laps)
    theirs, same = [], []
    if done >= LEAST:
        for scene, lap, own in zip(scenes, laps, ours, strict=True):
            theirs.append(judge(scene, lap, lap.scans))
            same.append(judge(scene, own, lap.scans))
    ratio = [a.cpu / b.cpu for a, b in zip(theirs, same, strict=True)]
    if done and not ratio:  # too few scans to judge, but enough to see the cost
        ratio = [a.cpu[-1] / b.cpu[a.scans - 1] for a, b in zip(laps, ours, strict=True)]
    return Row(
        title, done, len(scenes[0].times), len(scenes), _figures(theirs, same),
        float(np.mean(ratio)) if ratio else math.nan,
        1e3 * laps[0].cpu[-1] if done else math.nan, memory,
    )  # fmt: skip


def cost_ratio(theirs: Lap, ours: Lap) -> float:
    """Return the usual CPU of a scan by that of ours, in the scans that both did; NaN: too few."""
    scans = min(theirs.scans, ours.scans)
    mine, own = (typical(lap.cpu[:scans], SETTLING) for lap in (theirs, ours))
    return mine / own


def _figures(theirs: Sequence[Verdict], same: Sequence[Verdict]) -> dict[str, Figure]:
    figures = {}
    for name in ('gospa', 'missed', 'false', 'rmse', 'held', 'switches', 'cpu') if theirs else ():
        value = np.array([getattr(v, name) for v in theirs], float)
        margin = value - np.array([getattr(v, name) for v in same], float)
        runs = len(value)
        error = float(np.std(margin, ddof=1) / math.sqrt(runs)) if runs > 1 else math.nan
        figures[name] = Figure(float(value.mean()), float(margin.mean()), error)
    return figures
