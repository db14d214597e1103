# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the figures of the studies look? Plain, readable, with units on the axes."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
import numpy as np
from PIL import Image

from tracking_core.batches import Floats

COLOURS = (
    '#1f6fb4', '#d1495b', '#3a9d5d', '#8e5ea2', '#e0902b', '#4d5966', '#17a2a2', '#7a5c3e',
)  # fmt: skip
STYLE = {'font.size': 9, 'axes.grid': True, 'grid.color': '#e4e8ee', 'axes.axisbelow': True}


def panels(rows: int, columns: int, width: float = 8.0, height: float = 3.0) -> tuple[Figure, Any]:
    """Return a figure and its axes (rows, columns), each so many inches high."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(width, height * rows), layout='constrained')
        axes = figure.subplots(rows, columns, squeeze=False)
    for panel in axes.flat:
        panel.spines[['top', 'right']].set_visible(False)
    return figure, axes


def lines(
    panel: Any, x: Floats, curves: Mapping[str, Floats], across: str, up: str, title: str = ''
) -> None:
    """Draw named curves over x, with the names and units of the axes."""
    for (name, y), colour in zip(curves.items(), COLOURS, strict=False):
        panel.plot(x, y, color=colour, lw=1.5, label=name)
    panel.set_xlabel(across)
    panel.set_ylabel(up)
    panel.set_title(title, fontsize=10, loc='left')
    panel.legend(fontsize=8, frameon=False)


def surface(panel: Any, x: Floats, y: Floats, z: Floats, levels: int = 12) -> Any:
    """Draw z (Y, X) as filled, labelled contours; returns them for a colour bar."""
    filled = panel.contourf(x, y, z, levels, cmap='viridis')
    marked = panel.contour(x, y, z, filled.levels[::2], colors='white', linewidths=0.7)
    panel.clabel(marked, fontsize=7)
    panel.grid(visible=False)
    return filled


def shade(panel: Any, spans: Mapping[str, tuple[float, float]]) -> None:
    """Mark spans of the x axis."""
    for start, end in spans.values():
        panel.axvspan(start, end, color='#f3e3c3', zorder=0)


def save(figure: Figure, path: Path) -> str:
    """Write the figure and return the Markdown that shows it beside its report."""
    path.parent.mkdir(parents=True, exist_ok=True)
    drawn = BytesIO()
    figure.savefig(drawn, dpi=90)
    Image.open(drawn).convert('RGB').quantize(64).save(path, optimize=True)
    return f'![{path.stem}]({path.name})'


def rms(values: Floats, axis: int | None = -1) -> Floats:
    """Return the root of the mean square over an axis."""
    return np.asarray(np.sqrt(np.mean(values**2, axis=axis)))
