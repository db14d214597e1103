# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of two contacts whose bearings cross? Runs of scenario V-0 of [VORONINA19].

The paper's tracker and ours on the same marks of the same simulated array.
"""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
import math
from typing import Any

import numpy as np

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from studies.v0_scenes import DEGREE, marks, truth
from tracking_core.batches import Floats, Ints
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_tools.scoring.segments import relative_tracking_time, segment_lengths

SEED = 20190300
NEAR = 1.0 * DEGREE  # a track further off follows something else
RESOLUTION = 2.1 * DEGREE  # at broadside: two marks of this array become one below
_PER_CYCLE = 1.0 / math.sqrt(2.0)  # noise of a cycle of 2 s as noise per sqrt(s)

Values = dict[str, Any]
PAPER: Values = {
    'sensor.array': 'linear',
    'sensor.sector_centre': -0.5 * np.pi,
    'sensor.sector_width': 160.0 * DEGREE,
    'sensor.detection_probability': 0.9,
    'clutter_density': 0.0015 / DEGREE,
    'gate.probability': 0.886,
    'estimator': 'kalman_decoupled',
    'motion.bearing_noise': [0.005 * DEGREE * _PER_CYCLE],
    'motion.rate_noise': [1e-4 * DEGREE * _PER_CYCLE],
    'motion.memory': 15,
    'lifecycle': 'error_ratio',
    'initiation.rate_max': 0.2 * DEGREE,
    'initiation.rate_sd': 0.02 * DEGREE,
    'merge.distance': 2.0,
    'ranging.enabled': False,
}
OURS: Values = {
    **PAPER,
    'gate.probability': 0.99,
    'estimator': 'modified_polar',
    'motion.range_prior': 'sea',
    'motion.bearing_noise': [1e-6],
    'motion.rate_noise': [1e-8],
    'sensor.bearing_resolution': RESOLUTION,
    'lifecycle': 'm_of_n',
    'm_of_n.drop_misses': 10,
}


@dataclass(frozen=True)
class Run:
    """One run: which confirmed track was on which contact."""

    id: Ints  # (K, C) of the track nearest to each contact, -1: none
    error: Floats  # (K, C) [rad], NaN: no track
    sd: float  # median computed sd of the tracks in the second half [rad]
    false: int  # confirmed tracks that were never near a contact
    record: tuple[Floats, Floats, Ints] | None = None  # time, bearing, id of all rows


def run(name: str, seed: int, values: Mapping[str, Any], end: float = np.inf, mark_sd: float = 0.0,
        keep: bool = False) -> Run:  # fmt: skip
    """Track one run and say which track was on which contact in each cycle."""
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    time, bearing, platform = truth(name)
    ids, errors, sds, rows, near = [], [], [], [], set()
    for k, message in enumerate(marks(name, seed, end, mark_sd)):
        tracks = tracker.track(message, platform)
        sure = tracks.confirmed
        states = bearing_states(tracks)
        who, where = tracks.id[sure], states.bearing[sure]
        found, error = _match(who, where, bearing[k])
        ids.append(found)
        errors.append(error)
        sds.append(states.bearing_sd[sure])
        off = np.abs(wrap_angle(where[:, None] - bearing[k])).min(axis=1, initial=np.inf)
        near |= set(who[off < NEAR].tolist())
        rows.append((np.full(len(who), time[k]), where, who))
    columns = [np.concatenate(column) for column in zip(*rows, strict=True)]
    record = (columns[0], columns[1], columns[2])
    false = len(set(record[2].tolist()) - near)
    sd = float(np.median(np.concatenate(sds[len(sds) // 2 :])))  # settled
    return Run(np.array(ids), np.array(errors), sd, false, record if keep else None)


def _match(who: Ints, where: Floats, bearing: Floats) -> tuple[Ints, Floats]:
    """Return for each contact the track that is nearest to it, and to which it is nearest."""
    found, error = np.full(len(bearing), -1), np.full(len(bearing), np.nan)
    if len(who):
        off = np.abs(wrap_angle(where[:, None] - bearing))
        best = off.argmin(axis=0)
        for contact, row in enumerate(best):
            if off[row, contact] < NEAR and off[row].argmin() == contact:
                found[contact], error[contact] = who[row], off[row, contact]
    return found, error


def runs(name: str, count: int, values: Mapping[str, Any], jobs: int, end: float = np.inf,
         mark_sd: float = 0.0) -> list[Run]:  # fmt: skip
    """Return runs with seeds of their own, the same for every tracker."""
    tasks = [(name, SEED + k, values, end, mark_sd) for k in range(count)]
    if jobs == 1:
        return [run(*task) for task in tasks]
    with ProcessPoolExecutor(jobs) as pool:
        return list(pool.map(run, *zip(*tasks, strict=True), chunksize=2))


def segments(ids: Ints) -> tuple[Floats, Ints]:
    """Return of each contact the mean length of unbroken tracks over the time, and the breaks."""
    share = [relative_tracking_time(column) for column in ids.T]
    breaks = [max(len(segment_lengths(column)) - 1, 0) for column in ids.T]
    return np.array(share), np.array(breaks)


def kept(one: Run, before: int, after: int) -> tuple[Any, bool]:
    """Return which contacts (C,) have the same track at both cycles, and whether any swapped."""
    old, new = one.id[before], one.id[after]
    held = (old >= 0) & (old == new)
    same = (old[:, None] >= 0) & (old[:, None] == new)
    return held, bool(same.sum() > held.sum())
