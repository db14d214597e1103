# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does the page look like in one picture? Growth of the CPU, and accuracy beside speed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers.entrants import OURS, VARIANTS
from benchmarks.peers.report import growing, Results
from studies.pictures import COLOURS, panels, save

MARKS = ('o', 's', '^', 'v', 'D', 'P', 'X', '<')


def draw(results: Results, path: Path) -> str:
    """Write the picture and return the Markdown that shows it; nothing without growth."""
    if len(growing(results)) < 2:
        return ''
    figure, axes = panels(1, 2, 10.0, 4.2)
    titles = {name: row.title for one in results.values() for name, row in one.rows.items()}
    for number, (name, title) in enumerate(titles.items()):
        look = {'color': COLOURS[number % len(COLOURS)], 'marker': MARKS[number % len(MARKS)],
                'label': title, 'ms': 5.0}  # fmt: skip
        _growth(axes[0, 0], results, name, look)
        if name not in (OURS, *VARIANTS):
            _place(axes[0, 1], results, name, look)
    _dress(axes[0, 0], 'contacts', 'CPU a scan [ms]', 'Growth, en route')
    axes[0, 0].set_yscale('log')
    axes[0, 0].yaxis.set_major_formatter('{x:g}')
    axes[0, 1].axhline(1.0, color='#4d5966', lw=0.8)
    axes[0, 1].axvline(1.0, color='#4d5966', lw=0.8)
    _dress(axes[0, 1], 'CPU by ours', 'GOSPA by ours', 'A mark for each scene; 1 is ours')
    named = axes[0, 0].get_legend_handles_labels()
    figure.legend(*named, loc='outside lower center', ncols=4, fontsize=8, frameon=False)
    return save(figure, path)


def _growth(panel: Any, results: Results, name: str, look: dict[str, Any]) -> None:
    known = [(results[size], results[size].rows.get(name)) for size in growing(results)]
    points = [(one.contacts, row.figures['cpu'].mean if row.figures else row.last)
              for one, row in known if row is not None]  # fmt: skip
    panel.plot(*np.reshape(points, (-1, 2)).T, lw=1.2, **look)


def _place(panel: Any, results: Results, name: str, look: dict[str, Any]) -> None:
    rows = [one.rows[name] for one in results.values() if name in one.rows]
    gospa = [(row.ratio, row.figures['gospa']) for row in rows if row.figures]
    points = [(ratio, g.mean / (g.mean - g.margin)) for ratio, g in gospa]
    panel.plot(*np.reshape(points, (-1, 2)).T, ls='', alpha=0.8, **look)


def _dress(panel: Any, across: str, up: str, title: str) -> None:
    panel.set(xscale='log', xlabel=across, ylabel=up)
    panel.xaxis.set_major_formatter('{x:g}')
    panel.xaxis.set_minor_formatter('')
    panel.set_title(title, fontsize=10, loc='left')
