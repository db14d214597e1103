# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a sonar's scene is drawn: bearing-time record, a closer look at a crossing, ranges."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure
import numpy as np

from tracking_session.node_config import Configs
from tracking_tools.arguments import make_folder
from tracking_tools.bearing_frame import frame_of_tracks
from tracking_tools.bearing_panels import draw_nothing, draw_ranges, draw_record, MINUTE
from tracking_tools.bearing_scene import BearingScene, read_bearing_scene
from tracking_tools.crossing_panel import draw_crossing
from tracking_tools.crossings import find_crossings
from tracking_tools.picture import save
from tracking_tools.picture_style import BACK, FAINT, INK
from tracking_tools.replay_topics import Topics

SIZE, DPI = (12.8, 10.0), 115  # inches: 1472 x 1150 pixels
BITS = 5  # of a colour: the glow is smooth and would cost many bytes
NEAR = float(np.radians(1.3))  # tracks so near are looked at together


def draw_recording(
    recording: Path, tracks: Path, topics: Topics, configs: Configs, path: Path
) -> None:
    """Write a picture of a recording and of the tracks that came out."""
    tracker, node = configs
    fields = vars(node.fields)
    draw(read_bearing_scene(recording, tracks, topics, tracker.sensor, fields), path)


def draw(scene: BearingScene, path: Path | str, title: str = 'Sonar bearings to tracks') -> None:
    """
    Write a picture of the scene (PNG).

    Parameters
    ----------
    scene : BearingScene
        With confirmed tracks; the truth is drawn where there is one.
    path : Path or str
        File to write.
    title : str
        What the picture is of.

    """
    figure = Figure(figsize=SIZE, dpi=DPI, facecolor=BACK)
    grid = figure.add_gridspec(
        2, 2, width_ratios=(1.5, 1.0), height_ratios=(1.25, 1.0), left=0.055, right=0.98,
        top=0.885, bottom=0.055, hspace=0.22, wspace=0.14,
    )  # fmt: skip
    record = figure.add_subplot(grid[:, 0])
    frame = frame_of_tracks(scene)
    draw_record(record, scene, frame)
    crossings = find_crossings(scene.tracks, NEAR)
    closer, ranges = (figure.add_subplot(grid[row, 1]) for row in (0, 1))
    if crossings:
        crossing = max(crossings, key=lambda c: c.end - c.start)
        draw_crossing(closer, record, frame, scene, crossing)
    else:
        draw_nothing(closer, 'No tracks cross')
    draw_ranges(ranges, scene, frame)
    figure.text(0.055, 0.967, title, color=INK, fontsize=18, fontweight='bold', va='center')
    figure.text(0.055, 0.935, _what(scene), color=FAINT, fontsize=10.5, va='center')
    make_folder(Path(path).parent)
    save(figure, path, BITS)


def _what(scene: BearingScene) -> str:
    times = scene.marks.get('time', np.zeros(1))
    ids = len(np.unique(scene.tracks.get('id', ())))
    parts = [f'{np.ptp(times) / MINUTE:.0f} minutes', f'{len(times)} marks']
    if scene.has_truth:
        parts.append(f'{len(np.unique(scene.truth["id"]))} contacts')
    return '   ·   '.join([*parts, f'{ids} confirmed tracks'])
