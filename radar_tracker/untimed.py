# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do plots that tell no times come from a platform that turns? Then they are turned wrongly."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tracking_core.batches import Plots
from tracking_core.platform import Platform
from tracking_session.doubts import Doubt

_AGREEING = 3  # messages in a row that show it
_LONGEST = 60.0  # s from message to message


class UntimedPlots:
    """
    Watches how far own ship turns from message to message, where all plots have its stamp.

    Parameters
    ----------
    azimuth_sd : float
        Half of a turn by less does not matter [rad].

    """

    def __init__(self, azimuth_sd: float) -> None:
        self._least = 2.0 * azimuth_sd
        self._last, self._count, self._turned = np.nan, 0, 0.0

    def note(self, plots: Plots, platform: Platform | None) -> None:
        """Take note of one message."""
        step, self._last = plots.stamp - self._last, plots.stamp
        if platform is None or len(plots) < 2 or not 0.0 < step < _LONGEST:
            return
        if (plots.time != plots.stamp).any():
            self._count = 0
            return
        self._turned = step * abs(float(platform.at(np.array([plots.stamp])).turn_rate[0, 2]))
        self._count = self._count + 1 if self._turned > self._least else 0

    def doubts(self) -> Iterator[Doubt]:
        """Yield what is wrong."""
        if self._count >= _AGREEING:
            yield Doubt(
                'plots tell no times while own ship turns',
                'plots tell no times, and own ship turns by '
                f'{np.degrees(self._turned):.1f} degrees from message to message: all are taken '
                'as seen at the stamp. Give each plot a time; if a message is a look everywhere '
                'at once, set scan.assembly to snapshot',
            )
