# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do rules like "innovation large before and now: raise the gain far" become a number?

Mamdani inference, for all tracks at once: every rule holds as much as the weaker of its two
conditions (min), every conclusion as much as its strongest rule (max), the conclusions' sets are
cut at that height and joined, and the centre of area of what remains is the answer. Sets and
rules are data.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Floats

_STEPS = 400  # of the grid on which the centre of area is found


@dataclass(frozen=True)
class FuzzySets:
    """
    Fuzzy sets of one variable: a triangle over each peak, down to 0 at its neighbours.

    Beyond the first and the last peak these two sets hold fully, so that every value belongs to
    its sets with a sum of 1.
    """

    peaks: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.peaks) < 2 or (np.diff(self.peaks) <= 0.0).any():
            raise ValueError(f'peaks of fuzzy sets must be two or more, rising; got {self.peaks}')

    def membership(self, value: Floats) -> Floats:
        """Return how much the values (...) belong to each set (..., sets)."""
        heights = np.eye(len(self.peaks))
        return np.stack([np.interp(value, self.peaks, row) for row in heights], axis=-1)


@dataclass(frozen=True)
class Rules:
    """
    A table of rules over two values of one variable.

    References
    ----------
    [KHACH02], rule table; print (5) takes the minimum over all memberships, which is always 0.

    """

    condition: FuzzySets
    conclusion: FuzzySets
    table: tuple[tuple[int, ...], ...]  # rows: set before, columns: set now; set concluded

    def __post_init__(self) -> None:
        size, table = len(self.condition.peaks), np.array(self.table)
        if table.shape != (size, size):
            raise ValueError(f'table of rules must be {size} x {size}, got {table.shape}')
        if table.min() < 0 or table.max() >= len(self.conclusion.peaks):
            raise ValueError(
                f'rules must conclude sets 0 to {len(self.conclusion.peaks) - 1}, got {self.table}'
            )

    def infer(self, before: Floats, now: Floats) -> Floats:
        """Return the conclusion (T,) from the values before and now (T,)."""
        return self._centre(self._strength(before, now))

    def _strength(self, before: Floats, now: Floats) -> Floats:
        """Return how much each concluded set holds (T, sets): the best of its rules."""
        was, is_now = self.condition.membership(before), self.condition.membership(now)
        rules = np.minimum(was[:, :, None], is_now[:, None, :])  # (T, before, now)
        table = np.array(self.table)
        return np.stack(
            [
                np.where(table == i, rules, 0.0).max(axis=(1, 2))
                for i in range(len(self.conclusion.peaks))
            ],
            axis=1,
        )

    @cached_property
    def _grid(self) -> tuple[Floats, Floats]:
        """Values of the conclusion (G,), mid-points, and their memberships (sets, G)."""
        edges = np.linspace(self.conclusion.peaks[0], self.conclusion.peaks[-1], _STEPS + 1)
        middle = 0.5 * (edges[1:] + edges[:-1])
        return middle, self.conclusion.membership(middle).T

    def _centre(self, strength: Floats) -> Floats:
        """Return the centre of area of the sets, each cut at its strength (T, sets)."""
        values, membership = self._grid
        area = np.zeros((len(strength), len(values)))
        for height, shape in zip(strength.T, membership, strict=True):
            np.maximum(area, np.minimum(height[:, None], shape), out=area)
        return np.asarray((area @ values) / area.sum(axis=1))


KHACHATUROV = Rules(  # very small, small, medium, large
    condition=FuzzySets((0.0, 2.0, 4.0, 6.0)),
    conclusion=FuzzySets((0.0, 0.2, 0.5, 1.0)),
    table=((0, 2, 3, 3), (1, 2, 3, 3), (2, 2, 3, 3), (2, 3, 3, 3)),
)
