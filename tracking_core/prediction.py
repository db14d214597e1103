# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where are the tracks when the antenna points at them?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Ints, Mixture, Scan, Tracks
from tracking_core.composition import Setup
from tracking_core.looks import inside_coverage, margins, next_looks
from tracking_core.pairing import Gates, open_gates, thresholds
from tracking_core.rows import take

_GATES_APART = 2.0  # 3-sigma gates between a track and where its next gate may begin


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


def predict_tracks(tracks: Tracks, scan: Scan, setup: Setup) -> Predicted:
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


def is_passed_again(updated: Tracks, scan: Scan) -> bool:
    """Return whether the antenna has come to a track near the cut a second time in a message."""
    if abs(scan.coverage.sweep) < np.pi:
        return False
    mean, _ = updated.planes[0].moments()
    looks = next_looks(mean[:, 0::2], mean[:, 1::2], updated.time, scan.coverage)
    # A pass that has only begun counts: its plot may be here already, and must wait.
    size = _GATES_APART * updated.gate_size[:, :2].max(axis=1, initial=0.0)
    begun = looks.time - margins(mean[:, 0::2], size, scan.coverage)
    return bool((begun <= scan.coverage.end_time).any())


def longest_lag(near: Predicted, scan: Scan) -> Floats:
    """Return how far in time a plot of this look may be from the pass (T,) [s]."""
    if scan.coverage.rotation_rate:
        return near.margin
    return np.full(len(near.time), 0.5 * (scan.coverage.end_time - scan.coverage.start_time))
