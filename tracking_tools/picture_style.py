# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which colours and lines pictures have."""

from __future__ import annotations

from typing import Any

import matplotlib.patheffects as effects

BACK, PANEL, INK, FAINT, LINES = '#0b1320', '#101b2c', '#e2eaf5', '#8595ab', '#26364d'
PLOT, NEAR_PLOT, TRUE = '#6f86a6', '#a9bdd8', '#ffffff'
MARK = '#7fb8a4'  # of a sonar
PROBABILITY, TURN = '#ffb454', '#5ec8f2'
COLOURS = (
    '#4cc9f0', '#f9c74f', '#f25f5c', '#90be6d', '#c77dff', '#f8961e', '#43c59e', '#ff8fab',
    '#c6e377', '#7aa2ff', '#ffd6a5', '#e56bd3',
)  # fmt: skip
OUTLINE = (effects.withStroke(linewidth=2.2, foreground=BACK),)


def colour_of(number: int) -> str:
    """Return the colour of a track."""
    return COLOURS[number % len(COLOURS)]


def dress(axes: Any, x: str, y: str, title: str) -> None:
    """Give a panel its colours, units and title."""
    axes.set_facecolor(PANEL)
    axes.set_xlabel(x, color=INK, fontsize=9.5)
    axes.set_ylabel(y, color=INK, fontsize=9.5)
    axes.set_title(title, color=INK, fontsize=11, loc='left', pad=6)
    axes.tick_params(colors=FAINT, labelsize=8.5, length=3)
    for side in axes.spines.values():
        side.set_color(LINES)


def legend(axes: Any, **where: Any) -> None:
    """Add a legend in the colours of the panel."""
    box = axes.legend(
        fontsize=8.5,
        labelcolor=INK,
        facecolor=BACK,
        edgecolor=LINES,
        framealpha=0.85,
        **where,
    )
    box.set_zorder(20)
