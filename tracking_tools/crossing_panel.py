# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a crossing is drawn: bearings from the middle of both tracks, so that they open up."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.ndimage import uniform_filter1d

from msg_adapters.table import Columns
from tracking_core.batches import Bools, Floats
from tracking_core.linalg import wrap_angle
from tracking_tools.bearing_frame import Frame
from tracking_tools.bearing_scene import BearingScene
from tracking_tools.crossings import bearing_at, Crossing
from tracking_tools.picture_style import (
    colour_of,
    dress,
    FAINT,
    INK,
    legend,
    MARK,
    OUTLINE,
    TRUE,
)
from tracking_tools.scene import choose, of_id

MINUTE = 60.0
SDS = 2.0  # of the bands
BEFORE = 300.0  # shown before the tracks are near each other and after [s]
NARROWEST, WIDEST = 1.2, 6.0  # half width of what is shown [deg]
SMOOTH = 31  # cycles over which the number of marks is averaged
ALONE = 1.4  # marks a cycle; with fewer, two contacts are heard as one


def draw_crossing(
    axes: Any, record: Any, frame: Frame, scene: BearingScene, crossing: Crossing
) -> None:
    """
    Draw two tracks that cross.

    Parameters
    ----------
    axes : Axes
        Of the panel.
    record : Axes
        Where the place of the panel is shown.
    frame : Frame
        Of the record.
    scene : BearingScene
        All that there is.
    crossing : Crossing
        What is drawn.

    """
    one, other = crossing.ids
    title = f'Tracks {one} and {other} cross'
    dress(axes, 'bearing from the middle of both [deg, clockwise]', 'time [min]', title)
    middle = _middle(scene, crossing)
    tracks = choose(scene.tracks, np.isin(scene.tracks['id'], crossing.ids))
    half = _half_width(tracks, middle)
    _draw_shared(axes, scene, middle, half)
    _draw_marks(axes, scene, middle, half)
    for count, number in enumerate(np.unique(scene.truth.get('id', ()))):
        path = _within(of_id(scene.truth, int(number)), middle)
        axes.plot(
            _offset(path, middle), path['time'] / MINUTE, color=TRUE, linewidth=1.1, zorder=4,
            linestyle=(0, (5, 4)), alpha=0.85, label=None if count else 'true bearings',
        )  # fmt: skip
    for number in crossing.ids:
        _draw_track(axes, _within(of_id(tracks, number), middle), middle)
    axes.set_xlim(-half, half)
    axes.set_ylim(middle['time'][-1] / MINUTE, middle['time'][0] / MINUTE)
    legend(axes, loc='center right')
    for side in (-half, half):
        place = frame.degrees(middle['bearing']) + side
        record.plot(place, middle['time'] / MINUTE, color=INK, linewidth=0.8, zorder=6)


def _middle(scene: BearingScene, crossing: Crossing) -> Columns:
    """Return time and bearing of the middle of both tracks, around the crossing."""
    one, other = (of_id(scene.tracks, number) for number in crossing.ids)
    time, first, second = np.intersect1d(one['stamp'], other['stamp'], return_indices=True)
    apart = wrap_angle(other['bearing'][second] - one['bearing'][first])
    inside = (time >= crossing.start - BEFORE) & (time <= crossing.end + BEFORE)
    bearing = wrap_angle(one['bearing'][first] + 0.5 * apart)
    return {'time': time[inside], 'bearing': bearing[inside]}


def _within(rows: Columns, middle: Columns) -> Columns:
    time = rows['time']
    return choose(rows, (time >= middle['time'][0]) & (time <= middle['time'][-1]))


def _offset(rows: Columns, middle: Columns) -> Floats:
    """Return bearings from the middle, clockwise [deg]."""
    return np.degrees(wrap_angle(bearing_at(middle, rows['time']) - rows['bearing']))


def _half_width(tracks: Columns, middle: Columns) -> float:
    offset = np.abs(_offset(_within(tracks, middle), middle))
    return float(np.clip(1.25 * offset.max(), NARROWEST, WIDEST))


def _draw_marks(axes: Any, scene: BearingScene, middle: Columns, half: float) -> None:
    marks = _within(scene.marks, middle)
    offset = _offset(marks, middle)
    inside = np.abs(offset) < half
    axes.scatter(
        offset[inside], marks['time'][inside] / MINUTE, s=5.0, color=MARK, alpha=0.8,
        linewidths=0.0, zorder=2, label='marks',
    )  # fmt: skip


def _draw_shared(axes: Any, scene: BearingScene, middle: Columns, half: float) -> None:
    """Shade when both contacts had but one mark."""
    marks = _within(scene.marks, middle)
    near = np.abs(_offset(marks, middle)) < half
    row = np.searchsorted(middle['time'], marks['time'][near] - 1e-6)
    count = np.bincount(np.minimum(row, len(middle['time']) - 1), minlength=len(middle['time']))
    alone: Bools = uniform_filter1d(count.astype(np.float64), SMOOTH) < ALONE
    if not alone.any():
        return
    start, end = middle['time'][np.flatnonzero(alone)[[0, -1]]] / MINUTE
    axes.axhspan(start, end, color=INK, alpha=0.07, lw=0.0, zorder=0)
    axes.annotate(
        f'{end - start:.0f} minutes: one mark for both', (0.5, start), (0, -6),
        xycoords=axes.get_yaxis_transform(), textcoords='offset points', color=FAINT, fontsize=9,
        ha='center', va='top', path_effects=OUTLINE, zorder=8,
    )  # fmt: skip


def _draw_track(axes: Any, path: Columns, middle: Columns) -> None:
    """Draw a track with its band and its id at both ends."""
    number, offset = int(path['id'][0]), _offset(path, middle)
    colour, time = colour_of(number), path['time'] / MINUTE
    band = np.degrees(SDS * path['bearing_sd'])
    axes.fill_betweenx(time, offset - band, offset + band, color=colour, alpha=0.28, lw=0.0)
    axes.plot(
        offset, time, color=colour, linewidth=2.2, alpha=0.9, zorder=3,
        label=f'track {number}, {SDS:g} sd',
    )  # fmt: skip
    for row, down in ((0, -14), (-1, 8)):
        axes.annotate(
            str(number), (offset[row], time[row]), (0, down), textcoords='offset points',
            color=colour, fontsize=12, fontweight='bold', ha='center', path_effects=OUTLINE,
            zorder=8,
        )  # fmt: skip
