# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where are the tracks when the antenna points at them?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Bools, Floats, Ints, Mixture, Scan, Tracks
from tracking_core.composition import Setup
from tracking_core.gating import box_pairs
from tracking_core.looks import inside_coverage, margins, may_be_passed_again, next_looks
from tracking_core.pairing import Gates, open_gates, thresholds
from tracking_core.rows import change, take, take_rows

_CLOCK = 1e-6  # s; times since 1970 are good to 2.4e-7
_FARTHEST, _AFTER_MISS = 2.0, 4.0  # gates from a track, where its next one may begin


@dataclass(frozen=True)
class Predicted:
    """Tracks that the antenna passes, brought to the time of the pass."""

    row: Ints  # (T,) in all tracks
    tracks: Tracks  # planes, existence and time are predicted, the rest is of their last look
    margin: Floats  # (T,) until the gate is left behind [s]
    gates: Gates
    detection: Floats  # (T,) P_D, 0 outside the coverage
    crowd: Floats  # (T,) plot space in the gate: how many strange plots it may hold

    @property
    def time(self) -> Floats:
        """When the antenna points at them (T,) [s]."""
        return self.tracks.time

    @property
    def planes(self) -> tuple[Mixture, ...]:
        """Predicted."""
        return self.tracks.planes


def predict_tracks(tracks: Tracks, scan: Scan, setup: Setup) -> Predicted:
    """Bring the tracks that the antenna is near to the time at which it points at them."""
    looks = next_looks(*_level_motion(tracks), tracks.time, scan.coverage)
    row = np.flatnonzero(looks.near)
    near, time = take(tracks, looks.near), looks.time[row]
    dt, sensor = time - near.time, scan.coverage.sensor_at(time)
    planes = tuple(
        plane.predict(mixture, dt, sensor)
        for plane, mixture in zip(setup.planes, near.planes, strict=True)
    )
    d = setup.sensor.dimensions
    threshold = thresholds(setup.gate_probability, d)[d]
    gates = open_gates(setup.planes, planes, setup.sensor, scan, threshold)
    widest = gates.half_size[:, :2].max(axis=1, initial=0.0)
    inside = inside_coverage(gates.centre, scan.coverage)
    predicted = change(
        near, planes=planes, time=time, existence_probability=setup.lifecycle.prior(near, dt)
    )
    return Predicted(
        row, predicted, margins(gates.centre, widest, scan.coverage), gates,
        np.where(inside, setup.sensor.detection_probability, 0.0),
        gates.volume * setup.sensor.clutter_volume(gates.centre, scan.coverage),
    )  # fmt: skip


def next_passes(
    updated: Tracks, half_size: Floats, lives: Bools, scan: Scan
) -> tuple[bool, Bools]:
    """
    Return whether the antenna has passed a living track once more in the same message.

    A sector does so only after a gap: the first pass was before it. The next pass may also have
    begun only: then its plots (M,) must wait, they are the other thing returned. `half_size`
    (T, d) is of the gates of this look, of any mode.
    """
    waiting = np.zeros(len(scan), bool)
    is_after_gap = scan.coverage.gaps[-1][1] == scan.coverage.start_time
    if abs(scan.coverage.sweep) < np.pi and not is_after_gap:
        return False, waiting
    gate = half_size[:, :2].max(axis=1, initial=0.0)
    size = np.where(updated.misses > 0, _AFTER_MISS, _FARTHEST) * gate
    motion = (*_level_motion(updated), updated.time, size)
    if not is_after_gap:
        lives = lives & may_be_passed_again(*motion, scan.coverage)
    rows = lives.nonzero()[0]
    if len(rows) == 0:
        return False, waiting
    position, velocity, time, size = (take_rows(part, rows) for part in motion)
    looks = next_looks(position, velocity, time, scan.coverage)
    margin = margins(position, size, scan.coverage)
    begun = looks.time - margin <= scan.coverage.end_time
    if begun.any():
        opened, late = (looks.time - margin)[begun].min(), looks.time[begun]
        plots = (scan.time >= opened).nonzero()[0]  # few; the others are too early
        place = position[begun] + velocity[begun] * (late - time[begun])[:, None]
        box = np.repeat(size[begun, None], 2, axis=1)
        track, plot = box_pairs(place, box, take_rows(scan.position[:, :2], plots))
        early = np.abs(scan.time[plots[plot]] - late[track]) <= margin[begun][track]
        waiting[plots[plot[early]]] = True
    # A little more than complete, lest a contact beside the cut takes turns at waiting or not.
    complete = looks.time + 2.0 * margin <= scan.coverage.end_time
    return bool(complete.any()), waiting


def _level_motion(tracks: Tracks) -> tuple[Floats, Floats]:
    """Return position and velocity (T, 2) over the ground; of a sonar bearing and rate (T, 1)."""
    mean = tracks.planes[0].average
    return mean[:, 0:4:2], mean[:, 1:4:2]


def longest_lag(near: Predicted, scan: Scan) -> Floats:
    """
    Return how far in time a plot of this look may be from the pass (T,) [s].

    Where nothing turns the first and the last plot are just so far, but for what rounding does.
    """
    if scan.coverage.rotation_rate:
        return near.margin + _CLOCK
    longest = 0.5 * (scan.coverage.end_time - scan.coverage.start_time)
    return np.full(len(near.time), longest + _CLOCK)
