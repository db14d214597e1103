# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does one look of the antenna tell about the tracks that it has passed?"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tracking_core.association import clusters
from tracking_core.batches import (
    Bools,
    Floats,
    Ints,
    Mixture,
    Scan,
    Tracks,
)  # fmt: skip
from tracking_core.composition import Density, Setup
from tracking_core.lifecycle import count_looks, has_left
from tracking_core.linalg import is_positive_definite, sum_by_track
from tracking_core.looks import inside_coverage, LONGEST_WAIT, margins, next_looks
from tracking_core.pairing import Gated, Gates, open_gates, pair, thresholds
from tracking_core.rows import put, take
from tracking_core.sharing import Share, share_plots


@dataclass(frozen=True)
class Predicted:
    """Tracks that the antenna passes, brought to the time of the pass."""

    row: Ints  # (T,) in all tracks
    tracks: Tracks  # as they were at their last look
    time: Floats  # (T,) of the pass [s]
    margin: Floats  # (T,) until the gate is left behind [s]
    planes: tuple[Mixture, ...]  # predicted
    gates: Gates
    existence_probability: Floats  # (T,) predicted
    detection: Floats  # (T,) P_D, 0 outside the coverage


@dataclass(frozen=True)
class Look:
    """The tracks after a look, and what became of the plots."""

    tracks: Tracks
    deleted: Bools  # (T,)
    broken: int  # tracks deleted because a covariance was not positive definite
    claimed: Floats  # (M,) chance that a known contact made the plot
    waiting: Bools  # (M,) in the gate of a track that the antenna has not passed yet
    passed: int  # tracks worked on
    pairs: int
    approximate: int  # tracks with marginals from belief propagation

    def and_then(self, second: Look) -> Look:
        """Return both looks as one."""
        claimed = self.claimed + second.claimed
        return Look(
            tracks=second.tracks,
            deleted=self.deleted | second.deleted,
            broken=self.broken + second.broken,
            claimed=claimed,
            waiting=(self.waiting | second.waiting) & (claimed == 0.0),
            passed=self.passed + second.passed,
            pairs=self.pairs + second.pairs,
            approximate=self.approximate + second.approximate,
        )


def look(tracks: Tracks, scan: Scan, setup: Setup, density: Density) -> Look:
    """
    Update every track that the antenna has passed, once, at the time of the pass.

    Parameters
    ----------
    tracks : Tracks
        T tracks, each at the time of its last look.
    scan : Scan
        M plots.
    setup : Setup
        Sensor, filters and rules.
    density : Density
        Of false plots and of new contacts.

    """
    near = _predict(tracks, scan, setup)
    bounds = thresholds(setup.gate_probability, setup.sensor.dimensions)
    gated = pair(
        setup.planes, near.planes, near.gates, near.time, _longest_lag(near, scan), scan, bounds
    )
    due = _due(near, gated, scan)
    waiting = np.zeros(len(scan), bool)
    waiting[gated.pairs.plot[~due[gated.pairs.track]]] = True

    gated = _of_tracks(gated, due & (near.detection > 0.0), due)
    passed = take(near, due)
    share = share_plots(
        passed.existence_probability, passed.detection, gated, scan, setup, density
    )
    updated, left, broken = _update(passed, gated, share, setup)

    claimed = np.asarray(np.bincount(gated.pairs.plot, share.claim, len(scan)), np.float64)
    deleted = np.zeros(len(tracks), bool)
    deleted[passed.row] = left | broken
    return Look(
        tracks=put(tracks, passed.row, updated),
        deleted=deleted,
        broken=int(broken.sum()),
        claimed=claimed,
        waiting=waiting & (claimed == 0.0),
        passed=len(passed.row),
        pairs=len(gated.pairs),
        approximate=int(share.approximate.sum()),
    )


def _predict(tracks: Tracks, scan: Scan, setup: Setup) -> Predicted:
    """Bring the tracks that the antenna is near to the time at which it points at them."""
    mean, _ = tracks.planes[0].moments()
    looks = next_looks(mean[:, 0::2], mean[:, 1::2], tracks.time, scan.coverage)
    row = np.flatnonzero(looks.near)
    near, time = take(tracks, row), looks.time[row]
    dt = time - near.time
    planes = tuple(
        plane.estimator.predict(mixture, dt)
        for plane, mixture in zip(setup.planes, near.planes, strict=True)
    )
    d = setup.sensor.dimensions
    threshold = thresholds(setup.gate_probability, d)[d]
    gates = open_gates(setup.planes, planes, setup.sensor, scan.coverage, threshold)
    widest = gates.half_size[:, :2].max(axis=1, initial=0.0)
    inside = inside_coverage(gates.centre, scan.coverage)
    return Predicted(
        row, near, time, margins(gates.centre[:, :2], widest, scan.coverage), planes, gates,
        setup.lifecycle.prior(near, dt), np.where(inside, setup.sensor.detection_probability, 0.0),
    )  # fmt: skip


def _longest_lag(near: Predicted, scan: Scan) -> Floats:
    """Return how far in time a plot of this look may be from the pass (T,) [s]."""
    if scan.coverage.rotation_rate:
        return near.margin
    return np.full(len(near.time), 0.5 * (scan.coverage.end_time - scan.coverage.start_time))


def _due(near: Predicted, gated: Gated, scan: Scan) -> Bools:
    """
    Return which tracks (T,) can be worked on.

    Not those whose gate is still being swept, and not those that compete with them for plots,
    unless they have waited long enough.
    """
    rate = scan.coverage.rotation_rate
    left_behind = near.time + near.margin <= scan.coverage.end_time
    if rate == 0.0 or left_behind.all():
        return left_behind if rate else np.ones(len(near.time), bool)
    label, _ = clusters(gated.pairs.track, gated.pairs.plot, len(near.time), len(scan))
    waits = np.zeros(len(near.time), bool)
    waits[label[~left_behind]] = True
    patience = LONGEST_WAIT * 2.0 * np.pi / abs(rate)
    overdue = near.time + near.margin + patience <= scan.coverage.end_time
    return np.asarray(left_behind & (~waits[label] | overdue))


def _of_tracks(gated: Gated, visible: Bools, kept: Bools) -> Gated:
    """Return the pairs of visible tracks, with tracks numbered as among the kept ones."""
    gated = take(gated, visible[gated.pairs.track])
    number = np.cumsum(kept) - 1
    return replace(gated, pairs=replace(gated.pairs, track=number[gated.pairs.track]))


def _update(
    passed: Predicted, gated: Gated, share: Share, setup: Setup
) -> tuple[Tracks, Bools, Bools]:
    """Return the updated tracks, which have ended, and which are no longer sound."""
    track, T = gated.pairs.track, len(passed.row)
    planes = tuple(
        plane.estimator.update(mixture, track, innovations, share.association)
        for plane, mixture, innovations in zip(
            setup.planes, passed.planes, gated.innovations, strict=True
        )
    )
    found = 1.0 - share.association.miss
    weighted = sum_by_track(share.association.probability * gated.distance, track, T)
    tracks = replace(
        count_looks(passed.tracks, found > 0.5),
        time=passed.time,
        planes=planes,
        existence_probability=share.existence_probability,
        gate_size=passed.gates.three_sigma,
        gate_volume=passed.gates.volume,
        nis=np.where(found > 0.5, weighted / np.maximum(found, 0.5), np.nan),
    )
    confirmed, ended = setup.lifecycle.judge(tracks, share.existence_probability)
    ended |= has_left(tracks, passed.detection > 0.0)
    sound = [is_positive_definite(mixture.covariance).all(axis=1) for mixture in planes]
    return replace(tracks, confirmed=confirmed), ended, ~np.all(sound, axis=0)
