# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which straight courses have the fits found, track by track?"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from tracking_core.batches import Bools, Floats, Ints

UNKNOWNS = 4  # x, y, vx, vy
_LATELY = 200.0  # s, in which contacts seldom turn one after another
_SEVERAL = 2  # of one nobody can say whether it turns


@dataclass(frozen=True)
class Courses:
    """What the fits have found, at the time of each track's newest mark that was fitted."""

    time: Floats  # (T,) [s], -inf: not fitted yet
    state: Floats  # (T, 4) x, y, vx, vy; NaN: not known
    covariance: Floats  # (T, 4, 4)
    straight: Floats  # (T,) when a straight course last explained all marks, -inf: never [s]
    bent: Floats  # (T,) when none did, if the heading was true [s]

    @staticmethod
    def unknown(tracks: int) -> Courses:
        """Return courses of which nothing is known."""
        return Courses(
            np.full(tracks, -np.inf),
            np.full((tracks, UNKNOWNS), np.nan),
            np.full((tracks, UNKNOWNS, UNKNOWNS), np.nan),
            np.full(tracks, -np.inf),
            np.full(tracks, -np.inf),
        )

    def of(self, old: Ints, ids: Ints) -> Courses:
        """Return the courses of other ids (T,), where these are of the old ones; NaN: unknown."""
        if np.array_equal(old, ids):
            return self
        _, new_rows, old_rows = np.intersect1d(ids, old, return_indices=True)
        result = Courses.unknown(len(ids))
        for column in fields(self):
            getattr(result, column.name)[new_rows] = getattr(self, column.name)[old_rows]
        return result

    def are_bent(self, now: float) -> Bools:
        """Return which tracks (T,) were lately on no straight course, were the heading true."""
        return np.asarray(self.bent > now - _LATELY)

    def doubt_heading(self, now: float) -> bool:
        """Return whether most of the tracks, and two at least, are bent: not all would turn."""
        bent = self.are_bent(now)
        seen = bent | np.isfinite(self.straight)
        return bool(bent.sum() >= _SEVERAL and bent.sum() > 0.5 * seen.sum())
