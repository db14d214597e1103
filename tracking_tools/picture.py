# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a scene is drawn: plan view, two closer looks, and what the tracker knew of a manoeuvre."""

from __future__ import annotations

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imsave
import numpy as np

from tracking_session.node_config import Configs
from tracking_tools.arguments import make_folder
from tracking_tools.highlights import find_meeting, find_turning, holding_window
from tracking_tools.panels import draw_plan, draw_probability, draw_window
from tracking_tools.picture_style import BACK, FAINT, INK
from tracking_tools.replay_topics import Topics
from tracking_tools.scene import read_scene, Scene

SIZE, DPI = (12.8, 10.6), 125  # inches: 1600 x 1325 pixels


def draw(scene: Scene, path: Path | str, title: str = 'Radar plots to tracks') -> None:
    """
    Write a picture of the scene (PNG).

    Parameters
    ----------
    scene : Scene
        With confirmed tracks; the truth is drawn where there is one.
    path : Path or str
        File to write.
    title : str
        What the picture is of.

    """
    figure = Figure(figsize=SIZE, dpi=DPI, facecolor=BACK)
    rows = figure.add_gridspec(
        2, 1, height_ratios=(2.9, 0.8), left=0.06, right=0.945, top=0.905, bottom=0.055,
        hspace=0.17,
    )  # fmt: skip
    grid = rows[0].subgridspec(2, 2, width_ratios=(1.66, 1.0), hspace=0.24, wspace=0.13)
    plan = figure.add_subplot(grid[:, 0])
    draw_plan(plan, scene)
    number = find_turning(scene)
    if number is not None:
        near = figure.add_subplot(grid[0, 1])
        shape = _shape(near)
        holding = holding_window(scene, number, shape)
        draw_window(near, plan, scene, holding, 'a')
        meeting = find_meeting(scene, shape, holding)
        if meeting is not None:
            draw_window(figure.add_subplot(grid[1, 1]), plan, scene, meeting, 'b')
        draw_probability(figure.add_subplot(rows[1]), scene, number)
    figure.text(0.06, 0.972, title, color=INK, fontsize=18, fontweight='bold', va='center')
    figure.text(0.06, 0.945, _what(scene), color=FAINT, fontsize=10.5, va='center')
    make_folder(Path(path).parent)
    save(figure, path)


def draw_recording(
    recording: Path, tracks: Path, topics: Topics, configs: Configs, path: Path
) -> None:
    """Write a picture of a recording and of the tracks that came out."""
    tracker, node = configs
    draw(read_scene(recording, tracks, topics, tracker.sensor, vars(node.fields)), path)


def save(figure: Figure, path: Path | str, bits: int = 6) -> None:
    """Write the picture, six bits a colour: nobody sees it, and it saves a third."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    kept = np.uint8(256 - (1 << (8 - bits)))
    pixels = np.asarray(canvas.buffer_rgba())[..., :3] & kept
    imsave(path, pixels, format='png', pil_kwargs={'compress_level': 9})


def _shape(axes: object) -> float:
    """Return width over height of a panel."""
    box = axes.get_position()  # type: ignore[attr-defined]
    return float(box.width * SIZE[0] / (box.height * SIZE[1]))


def _what(scene: Scene) -> str:
    times = scene.plots['time'] if len(scene.plots) else np.zeros(1)
    ids = len(np.unique(scene.tracks.get('id', ())))
    contacts = len(np.unique(scene.truth['id'])) if scene.has_truth else 0
    parts = [
        f'{np.ptp(times) / 60.0:.0f} minutes',
        f'{len(times)} plots',
        *([f'{contacts} contacts'] if contacts else []),
        f'{ids} confirmed tracks',
    ]
    return '   ·   '.join(parts)
