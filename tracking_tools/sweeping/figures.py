# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which figures of a run are shown, and what many runs say of them: mean and 95 % interval."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any

import numpy as np
from scipy.stats import t as student

from tracking_tools.evaluation.units import UNITS

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Shown:
    """A figure of the table."""

    title: str
    place: tuple[str, str]  # in the figures of a run
    is_distance: bool = False

    def of(self, figures: dict[str, Any]) -> float:
        """Return its value in one run, NaN where it is not known."""
        value = figures[self.place[0]][self.place[1]]
        scale = UNITS[figures['sensor']].scale if self.is_distance else 1.0
        return math.nan if value is None else scale * float(value)

    def named(self, sensor: str) -> str:
        """Return the title with its unit."""
        return f'{self.title} [{UNITS[sensor].far_unit}]' if self.is_distance else self.title


SHOWN = {
    'gospa': Shown('GOSPA', ('gospa', 'mean'), is_distance=True),
    'ospa': Shown('OSPA', ('ospa', 'mean'), is_distance=True),
    'held': Shown('coverage', ('held', 'coverage')),
    'switches': Shown('id switches', ('held', 'id_switches')),
    'lasting': Shown('lasting switches', ('held', 'lasting_switches')),
    'false': Shown('false tracks', ('held', 'false_tracks')),
    'rmse': Shown('RMSE', ('accuracy', 'rmse'), is_distance=True),
    'nees': Shown('NEES', ('nees_position', 'mean')),
}


@dataclass(frozen=True)
class Mean:
    """Of the runs in which the figure is known."""

    mean: float
    half: float  # of the 95 % interval of the mean; NaN for a single run
    runs: int

    def __str__(self) -> str:
        if self.runs == 0:
            return 'none'
        return f'{self.mean:.4g}' + ('' if math.isnan(self.half) else f' +- {self.half:.2g}')


def mean_of(values: Sequence[float]) -> Mean:
    """Return the mean with Student's interval; what is not known is left out."""
    known = np.array([value for value in values if not math.isnan(value)], np.float64)
    if len(known) == 0:
        return Mean(math.nan, math.nan, 0)
    half = math.nan
    if len(known) > 1:
        quantile = float(student.ppf(0.5 + 0.5 * CONFIDENCE, len(known) - 1))
        half = quantile * float(known.std(ddof=1)) / math.sqrt(len(known))
    return Mean(float(known.mean()), half, len(known))
