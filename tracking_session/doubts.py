# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do the plots say against the parameters? Said once in the log, and in the diagnostics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from tracking_core.batches import Floats
from tracking_core.bends import BELIEVED


class Doubt(NamedTuple):
    """What is doubtful, in short and at length."""

    what: str  # without values: the same doubt has the same words
    text: str


class Told(NamedTuple):
    """What is told of the noise of plots on one axis."""

    axis: str
    name: str  # of the parameter, or of the field of the plots
    sd: float | None  # None: each plot tells its own
    unit: str


def noise_doubts(plots: str, told: Iterable[Told], ratio: Floats, advice: str) -> Iterator[Doubt]:
    """Yield what is told too small, where the noise of the plots is `ratio` (d,) times that."""
    for (axis, name, sd, unit), times in zip(told, ratio.tolist(), strict=False):
        if times > BELIEVED:
            value = f'of the {plots}' if sd is None else f'= {sd:.3g} {unit}'
            fits = '' if sd is None else f' ({times * sd:.2g} {unit} fits)'
            yield Doubt(
                f'{name} is too small',
                f'{plots} of contacts are scattered {times:.1f} times as far in {axis} as {name} '
                f'{value} tells{fits}: {advice}',
            )
