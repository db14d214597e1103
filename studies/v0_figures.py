# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of many runs of scenario V-0? Shares and errors, by rows of runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from studies.v0_crossing import kept, Run, segments
from studies.v0_scenes import DEGREE
from tracking_core.batches import Ints

BEFORE, AFTER = 450, -5  # cycles: 900 s after the start, 10 s before the end
SETTLED = 50  # cycles after which errors count


def quiet_figures(kalman: Sequence[Run]) -> Callable[[Ints], dict[str, float]]:
    """Return what to say of the runs of the first 1000 s, by rows."""
    share = np.array([segments(one.id)[0] for one in kalman])
    cover = np.array([(one.id >= 0).mean(axis=0) for one in kalman])
    square = np.array([np.nanmean(one.error[SETTLED:] ** 2, axis=0) for one in kalman])
    false = np.array([one.false for one in kalman])

    def figures(rows: Ints) -> dict[str, float]:
        error = np.sqrt(square[rows].mean(axis=0)) / DEGREE
        values = {'false': float(false[rows].sum())}
        for contact in (0, 1):
            values[f'tracking time {contact + 1}'] = float(share[rows, contact].mean())
            values[f'coverage {contact + 1}'] = float(cover[rows, contact].mean())
            values[f'error {contact + 1}'] = float(error[contact])
        return values

    return figures


def crossing_figures(all_runs: Sequence[Run]) -> Callable[[Ints], dict[str, float]]:
    """Return the shares of runs that keep ids through the crossing, by rows."""
    judged = [kept(one, BEFORE, AFTER) for one in all_runs]
    held, swaps = np.array([h for h, _ in judged]), np.array([s for _, s in judged])
    extra = np.array([one.false for one in all_runs])

    def figures(rows: Ints) -> dict[str, float]:
        return {
            'kept': float(held[rows].all(axis=1).mean()),
            'stronger': float(held[rows, 0].mean()),
            'weaker': float(held[rows, 1].mean()),
            'swaps': float(swaps[rows].mean()),
            'false': float(extra[rows].mean()),
        }

    return figures


def wilson(share: float, count: int) -> str:
    """Return the 95 % interval of a share of so many runs, as text."""
    z = 1.96
    middle = (share + z**2 / (2 * count)) / (1 + z**2 / count)
    half = z / (1 + z**2 / count) * np.sqrt(share * (1 - share) / count + z**2 / (4 * count**2))
    return f'{max(middle - half, 0.0):.0%} to {min(middle + half, 1.0):.0%}'
