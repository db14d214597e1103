# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What was heard of each track, and from where? Marks in bounded number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.chances import TINY
from tracking_core.linalg import nearest_turn

_TIME, _BEARING, _WEIGHT = 0, 1, 4  # rows of `points`; 2 and 3 are x and y of own ship
_STRAIGHT = 0.003  # sds that a mean of two may be off before others are rather averaged
_NOISE = 4.0  # sds, within which marks that differ need not have turned


@dataclass(frozen=True)
class PastMarks:
    """Marks of T tracks, oldest first; those beyond the number of a track have weight 0."""

    time: Floats  # (T, K) [s]
    bearing: Floats  # (T, K) tracking axes [rad]
    weight: Floats  # (T, K) 1 / variance [1/rad^2]
    own: Floats  # (T, K, 2) where the sensor was [m]
    count: Ints  # (T,)


class BearingHistory:
    """
    Marks of each track, by track id; changed in place.

    When a track's rows are full, marks before the window are forgotten, and then the nearest
    neighbours in time become one: weighted means of time, bearing and sensor position, which is
    exact as far as the bearing goes straight from one to the other. So neighbours between which
    it turns far, as of a contact that passes near, count as farther apart.
    """

    def __init__(self, points: int, window: float) -> None:
        self.id: Ints = np.zeros(0, np.int64)  # (T,)
        self._points = np.zeros((5, 0, points))
        self._count: Ints = np.zeros(0, np.int64)
        self._window = window

    def remember(self) -> dict[str, Any]:
        """Return copies of all marks, tracks first."""
        points = np.swapaxes(self._points, 0, 1).copy()  # (T, 5, K)
        return {'id': self.id.copy(), 'count': self._count.copy(), 'points': points}

    def recall(self, memory: dict[str, Any]) -> None:
        """Have the marks that were remembered."""
        self.id, self._count = memory['id'].copy(), memory['count'].copy()
        self._points = np.swapaxes(memory['points'], 0, 1).copy()

    def follow(self, ids: Ints) -> None:
        """Keep the rows of these tracks (T,) only, in this order; new ones have no marks."""
        if np.array_equal(ids, self.id):
            return
        _, new, old = np.intersect1d(ids, self.id, return_indices=True)
        points = np.zeros((5, len(ids), self._points.shape[2]))
        count = np.zeros(len(ids), np.int64)
        points[:, new], count[new] = self._points[:, old], self._count[old]
        self.id, self._points, self._count = ids.copy(), points, count

    def add(self, rows: Ints, time: Floats, bearing: Floats, weight: Floats, own: Floats) -> None:
        """
        Add a mark to each of these rows.

        Parameters
        ----------
        rows : (N,) array
            Rows of the tracks, each once.
        time, bearing, weight : (N,) arrays
            Later than what there is [s]; tracking axes [rad]; 1 / variance [1/rad^2].
        own : (N, 2) array
            Position of the sensor [m].

        """
        full = rows[self._count[rows] == self._points.shape[2]]
        if len(full):
            self._make_room(full)
        mark = np.stack([time, bearing, own[:, 0], own[:, 1], weight])
        self._points[:, rows, self._count[rows]] = mark
        self._count[rows] += 1

    def newest(self) -> Floats:
        """Return the time of each track's newest mark (T,), -inf: none [s]."""
        last = self._points[_TIME, np.arange(len(self.id)), self._count - 1]
        return np.where(self._count > 0, last, -np.inf)

    def read(self, rows: Ints) -> PastMarks:
        """Return the marks of these rows (N,) that are in the window."""
        time, bearing, x, y, weight = self._points[:, rows]
        recent = time >= self.newest()[rows, None] - self._window
        kept = recent & (np.arange(time.shape[1]) < self._count[rows, None])
        return PastMarks(
            time, bearing, np.where(kept, weight, 0.0), np.stack([x, y], -1), kept.sum(axis=1)
        )

    def forget_older_half(self, rows: Ints) -> None:
        """Drop the older half of the marks of these rows (N,)."""
        place = np.arange(self._points.shape[2])
        count = self._count[rows, None]
        self._keep(rows, (place >= count // 2) & (place < count))

    def _make_room(self, rows: Ints) -> None:
        newest = self.newest()[rows, None]
        self._keep(rows, self._points[_TIME, rows] >= newest - self._window)
        crowded = rows[self._count[rows] > self._points.shape[2] * 3 // 4]
        if len(crowded):
            self._average_neighbours(crowded)

    def _keep(self, rows: Ints, kept: Bools) -> None:
        """Keep these marks (N, K) of the rows (N,)."""
        order = np.argsort(~kept, axis=1, kind='stable')
        count = kept.sum(axis=1)
        moved = np.take_along_axis(self._points[:, rows], order[None], axis=2)
        self._points[:, rows] = moved * (np.arange(kept.shape[1]) < count[:, None])
        self._count[rows] = count

    def _average_neighbours(self, rows: Ints) -> None:
        """Make one of each of the K / 4 nearest pairs of neighbours, counted from the oldest."""
        points = self._points[:, rows]
        K = points.shape[2]
        first, second = points[:, :, 0 : K - 1 : 2], points[:, :, 1::2].copy()
        second[_BEARING] = nearest_turn(second[_BEARING], first[_BEARING])
        gap = np.where(second[_WEIGHT] > 0.0, second[_TIME] - first[_TIME], np.inf)
        chosen = np.argsort(gap * (1.0 + _bend(first, second) / _STRAIGHT), axis=1, kind='stable')
        merged = np.zeros(gap.shape, bool)
        np.put_along_axis(merged, chosen[:, : K // 4], True, axis=1)
        merged &= np.isfinite(gap)

        total = first[_WEIGHT] + second[_WEIGHT]
        share = second[_WEIGHT] / np.where(total > 0.0, total, 1.0)
        mean = first + share * (second - first)
        mean[_WEIGHT] = total
        points[:, :, 0 : K - 1 : 2] = np.where(merged, mean, first)
        self._points[:, rows] = points
        kept = np.arange(K) < self._count[rows, None]
        kept[:, 1::2] &= ~merged
        self._keep(rows, kept)


def _bend(first: Floats, second: Floats) -> Floats:
    """
    Return how far the means of marks (5, N, P) may be off the bearing then (N, P), in their sds.

    On a straight pass b'' is at most 0.65 of the square of the greatest bearing rate, and a mean
    of two that are as sure is off by an eighth of it times the square of the time between them.
    """
    apart = np.abs(second[_BEARING] - first[_BEARING])
    sum_of_weights = first[_WEIGHT] + second[_WEIGHT]
    product = np.maximum(first[_WEIGHT] * second[_WEIGHT], TINY)
    turned = apart > _NOISE * np.sqrt(sum_of_weights / product)
    return np.asarray(turned * 0.08 * apart**2 * np.sqrt(sum_of_weights))
