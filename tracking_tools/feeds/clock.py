# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""On which day was a time of day? Over midnight, and for reports that come a little late."""

from __future__ import annotations

DAY = 86_400.0  # s


class DayClock:
    """
    Time of day to time since the epoch: the day that is nearest to the time before.

    Parameters
    ----------
    reference : float
        Some time less than half a day from the first report [s since the epoch, UTC].

    """

    def __init__(self, reference: float) -> None:
        self._near = reference

    def set(self, now: float) -> None:
        """Take a clock's word for what time it is about [s since the epoch]."""
        self._near = now

    def time(self, time_of_day: float) -> float:
        """Return the time [s since the epoch] of a time of day [s, UTC]."""
        apart = (time_of_day - self._near + 0.5 * DAY) % DAY - 0.5 * DAY
        self._near += apart
        return self._near
