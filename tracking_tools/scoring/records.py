# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is compared? What the tracker said scan by scan, and where everything really was."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from msg_adapters.tracks import AXES, kinematics
from tracking_core.batches import Bools, Floats, Ints, Tracks
from tracking_core.linalg import nearest_turn
from tracking_core.rows import take

FALSE_PLOT = -1


@dataclass(frozen=True)
class TrackRows:
    """Confirmed tracks as they were published: N rows, one for each track and scan."""

    scan: Ints  # (N,) number of the scan
    id: Ints  # (N,)
    time: Floats  # (N,) of the state [s]
    position: Floats  # (N, d) [m]
    velocity: Floats  # (N, d) [m/s]
    covariance: Floats  # (N, 2 d, 2 d) positions first, then velocities
    angular: bool = False  # positions are bearings [rad], velocities their rates

    def __len__(self) -> int:
        return len(self.id)

    def beside(self, row: Ints, place: Floats) -> Floats:
        """Return places (K, d) as seen from these rows: bearings in the turn of the row's."""
        return nearest_turn(place, self.position[row]) if self.angular else place

    @cached_property
    def is_new(self) -> Bools:
        """Which rows (N,) tell of another look than the rows of the track before it."""
        _, first = np.unique(np.stack([self.id, self.time], axis=1), axis=0, return_index=True)
        new = np.zeros(len(self), bool)
        new[first] = True
        return new


def confirmed_rows(scan: int, tracks: Tracks, output: str = 'mmse') -> TrackRows:
    """Return the confirmed tracks as rows of this scan; `output` as the tracker's."""
    tracks = take(tracks, tracks.confirmed)
    state, covariance = kinematics(tracks, output)
    d = sum(plane.mean.shape[-1] // 2 for plane in tracks.planes)
    at = np.concatenate([np.arange(d), AXES + np.arange(d)])
    return TrackRows(
        np.full(len(tracks), scan), tracks.id, tracks.time, state[:, at[:d]], state[:, at[d:]],
        covariance[:, at[:, None], at],
    )  # fmt: skip


def join_rows(parts: Sequence[TrackRows]) -> TrackRows:
    """Return the rows of all scans in one batch; at least one part."""
    names = ('scan', 'id', 'time', 'position', 'velocity', 'covariance')
    columns: Any = {n: np.concatenate([getattr(part, n) for part in parts]) for n in names}
    return TrackRows(**columns, angular=parts[0].angular)


@dataclass(frozen=True)
class TruePlaces:
    """Where one contact was at the times asked for."""

    position: Floats  # (N, d) [m]
    velocity: Floats  # (N, d) [m/s]
    turning: Bools  # (N,)


@dataclass(frozen=True)
class Truth:
    """Samples of the real trajectories, sorted by contact, then time."""

    id: Ints  # (K,)
    time: Floats  # (K,) [s]
    position: Floats  # (K, d) [m]
    velocity: Floats  # (K, d) [m/s]
    turning: Bools  # (K,) whether the contact manoeuvres there

    @staticmethod
    def of(
        ids: Ints, time: Floats, position: Floats, velocity: Floats, turning: Bools | None = None
    ) -> Truth:
        """Return columns of samples in any order as truth; without `turning` nobody turns."""
        turning = np.zeros(len(ids), bool) if turning is None else turning
        order = np.lexsort((time, ids))
        return Truth(ids[order], time[order], position[order], velocity[order], turning[order])

    def of_contact(self, contact: int) -> Truth:
        """Return the samples of one contact."""
        return take(self, slice(*np.searchsorted(self.id, [contact, contact + 1])))

    def at(self, times: Floats) -> TruePlaces:
        """
        Return where a single contact was at times (N,) [s]; beyond its samples it goes straight.

        Between samples positions follow the cubic through positions and velocities.
        """
        after = np.clip(np.searchsorted(self.time, times), 1, max(len(self.time) - 1, 1))
        before, after = after - 1, np.minimum(after, len(self.time) - 1)
        inner = np.clip(times, self.time[0], self.time[-1])
        span = np.maximum(self.time[after] - self.time[before], 1e-9)[:, None]
        s = (inner - self.time[before])[:, None] / span
        p0, p1 = self.position[before], self.position[after]
        v0, v1 = self.velocity[before], self.velocity[after]
        position = p0 + s * s * (3.0 - 2.0 * s) * (p1 - p0)
        position += span * s * (1.0 - s) * ((1.0 - s) * v0 - s * v1)
        velocity = v0 + s * (v1 - v0)
        position += velocity * (times - inner)[:, None]
        nearer = np.where(s[:, 0] < 0.5, before, after)
        return TruePlaces(position, velocity, self.turning[nearer])


@dataclass(frozen=True)
class PlotRows:
    """Plots in the tracking frame with the contact that made them, for scoring only."""

    time: Floats  # (M,) [s]
    position: Floats  # (M, d) [m]
    contact: Ints  # (M,) id of the contact, `FALSE_PLOT` for none
