# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One figure over one parameter, with 95 % intervals."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
import numpy as np

from tracking_tools.picture_style import BACK, colour_of, dress, legend
from tracking_tools.sweeping.figures import SHOWN
from tracking_tools.sweeping.table import Case


def draw_sweep(cases: Sequence[Case], path: Path, shown: str) -> None:
    """
    Draw a figure over the first parameter that changes; a line for each value of the others.

    Parameters
    ----------
    cases : sequence of Case
        All settings.
    path : Path
        File to write.
    shown : str
        Name of the figure.

    """
    names = list(cases[0].setting)
    changing = [n for n in names if len({str(case.setting[n]) for case in cases}) > 1]
    axis = (changing or [''])[0]
    lines: dict[str, list[Case]] = {}
    for case in cases:
        rest = {name: case.setting[name] for name in changing if name != axis}
        lines.setdefault(', '.join(f'{n}={v}' for n, v in rest.items()), []).append(case)
    sensor = cases[0].figures[0]['sensor']
    with mpl.rc_context({'font.family': 'DejaVu Sans'}):
        figure = Figure(figsize=(7.2, 4.4), facecolor=BACK, layout='constrained')
        axes = figure.subplots()
        for number, (label, along) in enumerate(lines.items()):
            _line(axes, along, axis, shown, label or None, colour_of(number))
        runs = len(cases[0].tasks)
        dress(
            axes, axis, SHOWN[shown].named(sensor), f'{runs} runs of each setting, 95 % intervals'
        )
        if len(lines) > 1:
            legend(axes, loc='best')
        figure.savefig(path, format='png', dpi=120, metadata={'Software': None})


def _line(
    axes: Any, cases: Sequence[Case], axis: str, shown: str, label: str | None, colour: str
) -> None:
    values = [case.setting.get(axis, 'as it is') for case in cases]
    if all(isinstance(value, (int, float)) for value in values):
        cases = sorted(cases, key=lambda case: case.setting[axis])
        values = sorted(values)
    else:
        values = [str(value) for value in values]
    means = [case.means()[shown] for case in cases]
    middle = np.array([m.mean for m in means])
    half = np.array([m.half if m.runs > 1 else 0.0 for m in means])
    axes.plot(values, middle, color=colour, marker='o', markersize=4.5, label=label)
    axes.fill_between(values, middle - half, middle + half, color=colour, alpha=0.15, lw=0.0)
