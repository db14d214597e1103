# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where the tracks were in the last scans, for drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Ints


@dataclass(frozen=True)
class Trails:
    """The last positions of every track, newest first."""

    id: Ints  # (T,)
    position: Floats  # (T, K, 3) [m], NaN before the track was there

    @staticmethod
    def empty(length: int) -> Trails:
        """Return trails of at most `length` positions, of no track yet."""
        return Trails(np.zeros(0, np.int64), np.zeros((0, length, 3)))

    def extend(self, ids: Ints, position: Floats) -> Trails:
        """Return the trails of these tracks (T,) with their newest positions (T, 3)."""
        trail = np.full((len(ids), *self.position.shape[1:]), np.nan)
        trail[:, 1:] = self.of(ids)[:, :-1]
        trail[:, 0] = position
        return Trails(ids, trail)

    def of(self, ids: Ints) -> Floats:
        """Return the positions (T, K, 3) of these tracks (T,) [m], NaN for those without."""
        trail = np.full((len(ids), *self.position.shape[1:]), np.nan)
        _, old, new = np.intersect1d(self.id, ids, assume_unique=True, return_indices=True)
        trail[new] = self.position[old]
        return trail
