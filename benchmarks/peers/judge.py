# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How good are the tracks of one tracker on one scene?"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from benchmarks.peers.race import Lap, typical
from benchmarks.peers.scenes import Scene
from tracking_core.batches import Floats, Ints
from tracking_core.rows import take
from tracking_tools.scoring import (
    continuity,
    gospa_of_scans,
    join_rows,
    match,
    TrackRows,
)

SETTLING = 5  # scans in which nobody can have tracks yet


@dataclass(frozen=True)
class Verdict:
    """Means over the scans after settling."""

    scans: int  # done within the time limit
    gospa: float  # [m] or [rad]
    missed: float  # contacts without a track, a scan
    false: float  # tracks without a contact, a scan
    rmse: float  # of the tracks that are on contacts
    held: float  # share of the time that contacts ought to be held
    switches: int
    cpu: float  # median of a scan [ms]


def judge(scene: Scene, lap: Lap, scans: int) -> Verdict:
    """Compare what a tracker said in the first scans with the truth."""
    scans = min(scans, lap.scans)
    seen = scene.first(scans)
    rows = join_rows([_as_rows(k, *said, scene) for k, said in enumerate(lap.rows[:scans])])
    cutoff = scene.knowledge.cutoff
    parts = gospa_of_scans(rows, seen.truth, seen.times, cutoff=cutoff)[SETTLING:]
    matches = match(rows, seen.truth, cutoff)
    late = take(matches, matches.scan >= SETTLING)
    begun = take(seen.stretches, seen.stretches.first_scan < scans)
    stretches = replace(begun, last_scan=np.minimum(begun.last_scan, scans - 1))
    whole = continuity(rows, matches, matches.track, stretches)
    return Verdict(
        scans=lap.scans,
        gospa=float(np.mean([p.total for p in parts])),
        missed=float(np.mean([p.missed for p in parts])),
        false=float(np.mean([p.false for p in parts])),
        rmse=float(np.sqrt(np.mean(late.distance**2))) if len(late) else float('nan'),
        held=whole.held,
        switches=whole.switches,
        cpu=typical(lap.cpu, SETTLING),
    )


def _as_rows(scan: int, ids: Ints, position: Floats, scene: Scene) -> TrackRows:
    """Return the tracks in the region; what goes on beyond it is nobody's fault."""
    inside = np.linalg.norm(position, axis=1) < scene.knowledge.region
    ids, position = ids[inside], position[inside]
    T, d = position.shape
    return TrackRows(
        np.full(T, scan), ids, np.full(T, scene.times[scan]), position,
        np.zeros((T, d)), np.zeros((T, 2 * d, 2 * d)),
    )  # fmt: skip
