# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When is a manoeuvre declared, and when is it over, from the innovations of a settled filter?"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Association, Bools, Floats, Innovations, Ints, Mixture
from tracking_core.chances import chi_square_bound
from tracking_core.gain_control import ControlledGain, surprise

_CALM = 2.0  # plots in a row below the bound that end a manoeuvre


@dataclass(frozen=True)
class Verdict:
    """What a detector says at one look, (T,) arrays."""

    declared: Bools
    before: Floats  # normalised innovation at the plot before
    now: Floats
    memory: Floats  # (T, 3) for the next look


@dataclass(frozen=True)
class Detector:
    """
    Declared when the normalised innovation exceeds its bound, over after two that do not.

    The innovation is normalised by what a filter with the quiet gain has on a straight path. With
    two axes its bound is that of two; what is returned is scaled to one axis, so that rules keep
    their meaning.

    References
    ----------
    [KHACH02] eq. 3 and 4: S0 = 2.5758 for one axis and a false alarm of 0.01.

    """

    COLUMNS = 3  # of memory: normalised innovation before, declared, plots in a row below

    filter: ControlledGain
    false_alarm: float

    @cached_property
    def bound(self) -> float:
        """S0 of one axis."""
        return self._bound(1)

    def _bound(self, axes: int) -> float:
        return float(np.sqrt(chi_square_bound(1.0 - self.false_alarm, axes)))

    def judge(
        self,
        memory: Floats,
        mixture: Mixture,
        track: Ints,
        innovations: Innovations,
        association: Association,
    ) -> Verdict:
        """Return what the plots of this look say; without a plot all stays as it was."""
        before, declared, calm = memory[:, 0], memory[:, 1] > 0.0, memory[:, 2]
        alpha = np.full(len(memory), self.filter.quiet_alpha)
        distance = self.filter.settled_distance(mixture, track, innovations, alpha)
        squared, hit = surprise(distance, track, association)
        now = np.sqrt(squared) * self.bound / self._bound(self.filter.axes)
        above = hit & (now > self.bound)
        calm = np.where(above, 0.0, calm + hit)
        still = above | (declared & (calm < _CALM))
        now = np.where(hit, now, before)
        return Verdict(still, before, now, np.stack([now, still, calm], axis=1))
