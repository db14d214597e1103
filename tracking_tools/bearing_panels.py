# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the bearing-time record and the ranges are drawn."""

from __future__ import annotations

from typing import Any

from matplotlib.colors import LinearSegmentedColormap
import numpy as np
from scipy.ndimage import gaussian_filter

from msg_adapters.table import Columns
from tracking_tools.bearing_frame import Frame
from tracking_tools.bearing_scene import BearingScene
from tracking_tools.picture_style import (
    BACK,
    colour_of,
    dress,
    FAINT,
    legend,
    LINES,
    MARK,
    OUTLINE,
    PANEL,
    TRUE,
    TURN,
)
from tracking_tools.scene import choose, of_id

MINUTE, KM = 60.0, 1000.0
SDS = 2.0  # of the bands
TURNING = 2e-3  # of own ship [rad/s]
ROWS, COLUMNS = 330, 280  # of the glow of the marks
FAINTEST = 0.07  # of the brightest
GLOW = LinearSegmentedColormap.from_list('glow', [PANEL, '#1d4f55', '#3f9e8d', '#c9f2d0'])


def draw_record(axes: Any, scene: BearingScene, frame: Frame) -> None:
    """Draw all marks and tracks, time running down."""
    dress(axes, 'bearing [deg from north, clockwise]', 'time [min]', '')
    _draw_glow(axes, scene, frame)
    _draw_turns(axes, scene, frame)
    for number in ids_of(scene.tracks):
        path = of_id(scene.tracks, number)
        _draw_line(axes, path, frame, color=colour_of(number), linewidth=1.5, zorder=3)
        for row in (0, -1):
            _label(axes, number, path, frame, row)
    axes.plot([], [], 'o', ms=4, color=MARK, label='marks')
    axes.plot([], [], color=colour_of(0), linewidth=1.5, label='tracks, with their ids')
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.end / MINUTE, frame.start / MINUTE)
    legend(
        axes, loc='lower left', bbox_to_anchor=(-0.015, 1.0), ncols=4, frameon=False,
        columnspacing=1.4,
    )  # fmt: skip


def draw_ranges(axes: Any, scene: BearingScene, frame: Frame) -> None:
    """Draw the ranges that became known, and those that are true."""
    dress(axes, 'time [min]', 'range [km]', f'Range from bearings alone, bands are {SDS:g} sd')
    tracks = scene.tracks
    known = tracks.get('observable', np.zeros(0)) > 0
    for number in ids_of(scene.truth):
        path = of_id(scene.truth, number)
        axes.plot(
            path['time'] / MINUTE, path['range'] / KM, color=TRUE, linewidth=0.9, alpha=0.8,
            linestyle=(0, (4, 5)), zorder=4,
        )  # fmt: skip
    for number in ids_of(choose(tracks, known)) if known.any() else ():
        _draw_range(axes, of_id(choose(tracks, known), number), number)
    first = float(tracks['time'][known].min()) if known.any() else frame.end
    axes.axvspan(frame.start / MINUTE, first / MINUTE, color=BACK, alpha=0.55, lw=0.0, zorder=1)
    axes.text(
        0.5 * (frame.start + first) / MINUTE, 0.12, 'not observable: no number is given',
        color=FAINT, fontsize=9.5, ha='center', transform=axes.get_xaxis_transform(),
    )  # fmt: skip
    turns = _turns(scene)
    if len(turns):
        axes.fill_between(
            scene.own['time'] / MINUTE, 0.0, 1.0, where=turns, color=TURN, alpha=0.18, lw=0.0,
            transform=axes.get_xaxis_transform(),
        )  # fmt: skip
    axes.set_xlim(frame.start / MINUTE, frame.end / MINUTE * 1.04)
    axes.set_ylim(0.0, None)
    axes.grid(color=LINES, linewidth=0.5)


def draw_nothing(axes: Any, words: str) -> None:
    """Say what there is not."""
    axes.set_axis_off()
    axes.text(0.5, 0.5, words, color=FAINT, fontsize=11, ha='center', va='center')


def ids_of(rows: Columns) -> list[int]:
    """Return the ids of tracks or contacts."""
    return [int(number) for number in np.unique(rows.get('id', ()))]


def _draw_glow(axes: Any, scene: BearingScene, frame: Frame) -> None:
    """Draw the marks as a screen shows them: the louder, the brighter."""
    if not len(scene.marks.get('time', ())):
        return
    snr = scene.marks['snr']
    loud = np.nan_to_num(snr - np.nanmin(snr)) if np.isfinite(snr).any() else np.zeros(len(snr))
    box = ((frame.start, frame.end), (frame.left, frame.right))
    light, _, _ = np.histogram2d(
        scene.marks['time'], frame.degrees(scene.marks['bearing']), (ROWS, COLUMNS), box,
        weights=3.0 + loud,
    )  # fmt: skip
    glow = np.sqrt(gaussian_filter(light, 0.8))
    glow[glow < FAINTEST * glow.max()] = 0.0  # smooth tails cost bytes and show nothing
    axes.imshow(
        glow, cmap=GLOW, aspect='auto', interpolation='bilinear', vmin=0.0, vmax=glow.max(),
        extent=(frame.left, frame.right, frame.end / MINUTE, frame.start / MINUTE), zorder=1,
    )  # fmt: skip


def _draw_line(axes: Any, path: Columns, frame: Frame, **line: Any) -> None:
    degrees = frame.degrees(path['bearing'])
    jumps = np.flatnonzero(np.abs(np.diff(degrees)) > 180.0) + 1  # once around
    x, y = np.insert(degrees, jumps, np.nan), np.insert(path['time'] / MINUTE, jumps, np.nan)
    axes.plot(x, y, **line)


def _turns(scene: BearingScene) -> Any:
    """Return when own ship turns, at each time of its odometry; nothing without."""
    if len(scene.own.get('time', ())) < 2:
        return np.zeros(0, bool)
    heading = np.unwrap(scene.own['heading'])
    return np.abs(np.gradient(heading, scene.own['time'])) > TURNING


def _draw_turns(axes: Any, scene: BearingScene, frame: Frame) -> None:
    turns = _turns(scene)
    if turns.any():
        axes.fill_betweenx(
            scene.own['time'] / MINUTE, frame.left, frame.right, where=turns, color=TURN,
            alpha=0.22, lw=0.0, label='own ship turns', zorder=2,
        )  # fmt: skip


def _draw_range(axes: Any, path: Columns, number: int) -> None:
    time, colour = path['time'] / MINUTE, colour_of(number)
    middle, half = path['range'] / KM, SDS * path['range_sd'] / KM
    axes.fill_between(time, middle - half, middle + half, color=colour, alpha=0.28, lw=0.0)
    axes.plot(time, middle, color=colour, linewidth=1.8, zorder=3)
    axes.annotate(
        str(number), (time[-1], middle[-1]), (6, -4), textcoords='offset points', color=colour,
        fontsize=10.5, fontweight='bold', path_effects=OUTLINE,
    )  # fmt: skip


def _label(axes: Any, number: int, path: Columns, frame: Frame, row: int) -> None:
    place = frame.degrees(path['bearing'][[row]])[0], path['time'][row] / MINUTE
    axes.annotate(
        str(number), place, (5, -12 if row == 0 else 5), textcoords='offset points',
        color=colour_of(number), fontsize=11.5, fontweight='bold', path_effects=OUTLINE, zorder=8,
    )  # fmt: skip
