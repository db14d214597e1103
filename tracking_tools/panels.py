# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How each panel of a picture is drawn."""

from __future__ import annotations

from typing import Any

from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle, Rectangle
import numpy as np

from tracking_tools.highlights import place_labels, smooth_turn_rate, true_path, TURNING, Window
from tracking_tools.picture_style import (
    colour_of,
    dress,
    FAINT,
    INK,
    legend,
    LINES,
    NEAR_PLOT,
    OUTLINE,
    PLOT,
    PROBABILITY,
    TRUE,
    TURN,
)
from tracking_tools.scene import choose, of_id, Scene

KM = 1_000.0
NONE = np.zeros(0)
MINUTE = 60.0
RINGS = 30  # at most
GATES = 14  # drawn of one track in a closer look, at most
MOST_NAMED = 2  # tracks in a title
MARGIN = 0.06  # of the plan around the tracks
SMALLEST = 1e-3  # plan [km]


def draw_plan(axes: Any, scene: Scene) -> None:
    """Draw the whole scene from above."""
    dress(axes, 'east [km]', 'north [km]', 'Plan view')
    x, y = (scene.plots.get(axis, NONE) / KM for axis in 'xy')
    axes.scatter(x, y, s=1.7, color=PLOT, alpha=0.45, linewidths=0.0)
    _draw_truth(axes, scene.truth, linewidth=2.6, alpha=0.3, zorder=2)
    for number in _ids(scene.tracks):
        path, colour = of_id(scene.tracks, number), colour_of(number)
        axes.plot(path['x'] / KM, path['y'] / KM, color=colour, linewidth=1.4, zorder=3)
        axes.plot(path['x'][-1] / KM, path['y'][-1] / KM, 'o', color=colour, ms=4, zorder=4)
    for number, place in place_labels(scene.tracks).items():
        _label(axes, number, (place[0] / KM, place[1] / KM))
    axes.plot([], [], 'o', ms=3, color=PLOT, label='plots')
    axes.plot([], [], color=colour_of(0), linewidth=1.5, label='tracks, with their ids')
    _frame(axes, scene)
    legend(axes, loc='upper left')


def draw_window(axes: Any, plan: Any, scene: Scene, window: Window, letter: str) -> None:
    """Draw a piece of the scene with gates, and its place on the plan."""
    plots = choose(scene.plots, window.shows(scene.plots)) if len(scene.plots) else {}
    tracks = choose(scene.tracks, window.shows(scene.tracks))
    who = ' and '.join(f'track {number}' for number in _ids(tracks)[:MOST_NAMED])
    when = f'minutes {window.start / MINUTE:.0f} to {window.end / MINUTE:.0f}'
    dress(axes, 'east [km]', 'north [km]', f'{letter}   {who}, {when}')
    axes.scatter(
        *(plots.get(axis, NONE) / KM for axis in 'xy'), s=15, facecolor='none',
        edgecolor=NEAR_PLOT, linewidths=0.9, label='plots', zorder=5,
    )  # fmt: skip
    if scene.has_truth:
        truth = choose(scene.truth, window.shows(scene.truth))
        _draw_truth(axes, truth, linewidth=0.9, linestyle=(0, (5, 4)), zorder=4)
    for number in _ids(tracks):
        _draw_track(axes, of_id(tracks, number), colour_of(number))
    axes.add_patch(Rectangle((0.0, 0.0), 0.0, 0.0, facecolor='none', edgecolor=INK, label='gates'))
    left, low = window.centre[0] - window.half[0], window.centre[1] - window.half[1]
    axes.set_xlim(left / KM, (left + 2.0 * window.half[0]) / KM)
    axes.set_ylim(low / KM, (low + 2.0 * window.half[1]) / KM)
    axes.set_aspect('equal')
    if letter == 'a':
        legend(axes, loc='lower right')
    box = (left / KM, low / KM), 2.0 * window.half[0] / KM, 2.0 * window.half[1] / KM
    plan.add_patch(Rectangle(*box, facecolor='none', edgecolor=INK, linewidth=0.9, zorder=7))
    plan.annotate(
        letter, box[0], (3, 3), textcoords='offset points', color=INK, fontsize=11,
        fontweight='bold', path_effects=OUTLINE, zorder=8,
    )  # fmt: skip


def draw_probability(axes: Any, scene: Scene, number: int) -> None:
    """Draw how likely a manoeuvre was for the tracker, and how fast the contact truly turned."""
    whose = 'true turn rate' if scene.has_truth else 'turn rate of the track'
    track, path = of_id(scene.tracks, number), true_path(scene, number)
    dress(axes, 'time [min]', 'manoeuvre probability', f'Track {number}: does it turn?')
    time, turn = path['time'] / MINUTE, smooth_turn_rate(path)
    axes.fill_between(
        time, 0.0, 1.0, where=np.abs(turn) > TURNING, color=TURN, alpha=0.16, linewidth=0.0,
        step='mid', label=f'turns faster than {np.degrees(TURNING):.1f} deg/s',
    )  # fmt: skip
    probability = track['manoeuvre_probability']
    axes.plot(
        track['time'] / MINUTE, probability, color=PROBABILITY, linewidth=1.7, zorder=3,
        label='manoeuvre probability of the track',
    )  # fmt: skip
    axes.set_xlim(time[0], time[-1])
    axes.set_ylim(0.0, 1.03)
    rate = axes.twinx()
    rate.plot(time, np.degrees(turn), color=TURN, linewidth=1.0, alpha=0.9)
    most = 1.15 * max(float(np.abs(np.degrees(turn)).max()), 1.0)
    rate.set_ylim(-most, most)
    dress(rate, '', f'{whose} [deg/s]', '')
    axes.plot([], [], color=TURN, linewidth=1.0, label=f'{whose} (left positive)')
    axes.set_zorder(rate.get_zorder() + 1)
    rate.patch.set_visible(True)
    axes.patch.set_visible(False)
    legend(axes, loc='lower right', bbox_to_anchor=(1.0, 1.0), ncols=3, frameon=False)


def _ids(rows: Any) -> list[int]:
    return [int(number) for number in np.unique(rows.get('id', ()))]


def _draw_truth(axes: Any, truth: Any, **line: Any) -> None:
    for number in _ids(truth):
        path = of_id(truth, number)
        axes.plot(path['x'] / KM, path['y'] / KM, color=TRUE, **line)
    if _ids(truth):
        axes.plot([], [], color=TRUE, **line, label='true paths')


def _label(axes: Any, number: int, place: tuple[float, float]) -> None:
    axes.annotate(
        str(number), place, (4, 4), textcoords='offset points', color=colour_of(number),
        fontsize=9.5, fontweight='bold', path_effects=OUTLINE, annotation_clip=True, zorder=8,
    )  # fmt: skip


def _draw_track(axes: Any, path: Any, colour: str) -> None:
    """Draw a track with its gates, every few looks, and the id at its end."""
    axes.plot(path['x'] / KM, path['y'] / KM, color=colour, linewidth=2.6, zorder=3)
    some = choose(path, slice(None, None, max(1, len(path['x']) // GATES)))
    boxes = [
        Rectangle(((x - w) / KM, (y - h) / KM), 2.0 * w / KM, 2.0 * h / KM)
        for x, y, w, h in zip(some['x'], some['y'], some['gate_x'], some['gate_y'], strict=True)
        if np.isfinite(w + h)
    ]
    axes.add_collection(
        PatchCollection(boxes, facecolor=colour, edgecolor='none', alpha=0.10, zorder=1)
    )
    axes.add_collection(
        PatchCollection(boxes, facecolor='none', edgecolor=colour, linewidth=0.8, zorder=3)
    )
    _label(axes, int(path['id'][0]), (path['x'][-1] / KM, path['y'][-1] / KM))


def _frame(axes: Any, scene: Scene) -> None:
    """Show all tracks and, where plots can be placed, the radar: with range rings, or its path."""
    rows = scene.tracks if len(scene.tracks.get('x', ())) else scene.plots
    own = [scene.plots.get(f'sensor_{axis}', NONE) / KM for axis in 'xy']
    x, y = (np.append(rows.get(axis, NONE) / KM, own[n]) for n, axis in enumerate('xy'))
    half = (0.5 + MARGIN) * max(np.ptp(x), np.ptp(y), SMALLEST) if len(x) else 1.0
    middle = [(v.min() + v.max()) / 2.0 if len(v) else 0.0 for v in (x, y)]
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    axes.set_aspect('equal')
    if not len(own[0]):
        return
    if np.ptp(own[0]) or np.ptp(own[1]):
        axes.plot(*own, '-', color=INK, linewidth=1.0, zorder=2, label='own ship')
        return
    here = (own[0][0], own[1][0])
    step = 2.0 * 10.0 ** np.floor(np.log10(half / 2.0))
    for ring in step * np.arange(1, RINGS + 1):
        axes.add_patch(Circle(here, ring, fill=False, edgecolor=LINES, linewidth=0.8))
    axes.plot(*here, '^', color=INK, markersize=8, zorder=7, label='radar')
    axes.annotate(
        f'range rings {step:g} km apart', (0.99, 0.01), xycoords='axes fraction', color=FAINT,
        fontsize=8.5, ha='right', va='bottom',
    )  # fmt: skip
