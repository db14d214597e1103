# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What a live node draws for RViz, as a picture: a recording is played to it, its markers are kept.

Nothing but the published MarkerArrays is drawn: what is wrong with them is wrong here too.
"""

from __future__ import annotations

import argparse
from collections.abc import Collection, Iterator, Sequence
from importlib import import_module
from pathlib import Path
import sys
from typing import Any

from matplotlib.figure import Figure
import numpy as np
from rosbags.highlevel import AnyReader

from msg_adapters.message_types import NANOSECONDS
from tracking_core.batches import Floats
from tracking_tools.arguments import file_to_write, make_folder, positive
from tracking_tools.bags import BadBag, open_bag
from tracking_tools.marker_shapes import draw_markers, places
from tracking_tools.node_process import NodeFailed, NodeProcess, private_domain, python_node
from tracking_tools.picture import save
from tracking_tools.picture_style import BACK, dress
from tracking_tools.presets import parameter_file
from tracking_tools.replay_topics import check_topics, messages_of, Topics
from tracking_tools.screen import Screen
from tracking_tools.sensors import SensorKind, SENSORS
from tracking_tools.stopping import stoppable

SIZE, DPI = (12.8, 8.4), 125  # inches
KILOMETRE, POINTS = 1000.0, 72.0  # metres in one, and points in an inch
Place = tuple[float, float, float, float]  # left, bottom, width, height in the figure
RATE = 100.0  # drawings a second: every scan of the recording is drawn


def play(recording: Path, parameters: Path, sensor: SensorKind, until: float, log: Path) -> Screen:
    """
    Play a recording to a live node and return what stands on a viewer's screen at the end.

    Parameters
    ----------
    recording : Path
        Bag with plots or bearings.
    parameters : Path
        Parameter file of the node.
    sensor : SensorKind
        Whose node it is.
    until : float
        Only the first so many seconds of the recording.
    log : Path
        File for what the node says.

    """
    recorder = import_module('tracking_tools.recording')  # needs rclpy
    markers = import_module('visualization_msgs.msg').MarkerArray
    topics, screen = Topics.of(sensor), Screen()
    rate = ['-p', f'markers.rate:={RATE}']
    command = python_node(f'{sensor.node}.node', '--params-file', str(parameters), *rate)
    with open_bag(recording) as bag, private_domain() as domain_id:
        check_topics(bag, topics, recording)
        own_ship = topics.ownship if topics.ownship in bag.topics else ''
        node = NodeProcess(command, domain_id, log)
        names = topics.plots, topics.tracks
        with node, recorder.open_player(*names, domain_id, node.check, own_ship) as player:
            seen = player.watch(markers, f'{topics.node}/markers')
            player.find_tracker()
            for topic, raw in _first_seconds(bag, (topics.plots, own_ship), until):
                if topic == own_ship:
                    player.tell_own_ship(raw)
                else:
                    player.ask(raw)
                    newest = recorder.stamp_of(raw)
            player.wait_for(lambda: screen.take_all(seen) == newest, 'its last drawing')
    return screen


def _first_seconds(
    bag: AnyReader, topics: Sequence[str], until: float
) -> Iterator[tuple[str, bytes]]:
    chosen = [connection for connection in bag.connections if connection.topic in topics]
    begun = None
    for connection, received, raw in messages_of(bag, chosen):
        begun = received if begun is None else begun
        if received - begun > until * NANOSECONDS:
            return
        yield connection.topic, raw


def draw(markers: Collection[Any], path: Path, title: str, window: Floats | None = None) -> None:
    """
    Write a picture of markers, seen from above.

    Parameters
    ----------
    markers : collection of Marker
        What is on the screen.
    path : Path
        File to write (PNG).
    title : str
        What it is of.
    window : (3,) array, optional
        Middle x, y and width [m] of a closer look beside the whole.

    """
    figure = Figure(figsize=SIZE, dpi=DPI, facecolor=BACK)
    share = 0.92 if window is None else 0.52
    _panel(figure, (0.06, 0.07, share, 0.87), markers, _all_of(markers), title)
    if window is not None:
        _panel(figure, (0.64, 0.07, 0.34, 0.87), markers, window, 'closer')
    make_folder(path.parent)
    save(figure, path)


def _panel(
    figure: Figure, place: Place, markers: Collection[Any], window: Floats, title: str
) -> None:
    axes = figure.add_axes(place)
    x, y, width = window
    _, _, across, up = place
    height = width * up * SIZE[1] / (across * SIZE[0])
    axes.set_xlim(x - 0.5 * width, x + 0.5 * width)
    axes.set_ylim(y - 0.5 * height, y + 0.5 * height)
    axes.xaxis.set_major_formatter(_kilometres)
    axes.yaxis.set_major_formatter(_kilometres)
    dress(axes, 'x (east) [km]', 'y (north) [km]', title)
    draw_markers(axes, markers, POINTS * across * SIZE[0] / width)


def _all_of(markers: Collection[Any]) -> Floats:
    """Return the middle x, y and the width [m] of a window that shows where everything is."""
    points = np.concatenate(
        [places(m) for m in markers if m.type != m.LINE_STRIP] or [np.zeros((1, 2))]
    )
    low, high = points.min(axis=0), points.max(axis=0)
    width = 1.2 * max(*(high - low), 1.0)
    return np.array([*(0.5 * (low + high)), width])


def _kilometres(metres: float, _: float) -> str:
    return f'{metres / KILOMETRE:g}'


@stoppable('marker_picture')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    chosen = _parser().parse_args(arguments)
    sensor, log = SENSORS[chosen.sensor], chosen.output.with_suffix('.log')
    try:
        window = _window(chosen)
        make_folder(chosen.output.parent)
        screen = play(chosen.recording, chosen.params, sensor, chosen.until, log)
        title = f'~/markers of {sensor.node}, as published: {len(screen.markers)} shapes'
        draw(screen.markers.values(), chosen.output, title, window)
    except (BadBag, NodeFailed, OSError, ValueError) as error:
        print(f'marker_picture: {error}', file=sys.stderr)
        return 1
    print(f'{len(screen.markers)} markers of {len(screen.ids())} tracks: {chosen.output}')
    return 0


def _window(chosen: argparse.Namespace) -> Floats | None:
    """Return x, y and width of the closer look [m], None for all; ValueError for none that is."""
    if chosen.window is None:
        return None
    window = np.array(chosen.window)
    if not (np.isfinite(window).all() and window[2] > 0.0):
        raise ValueError(
            '--window must be X Y WIDTH, finite, with a width above 0 m, got '
            + ' '.join(f'{value:g}' for value in window)
        )
    return window


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='marker_picture',
        description='Play a recording to a live node; draw the markers that it publishes.',
    )
    add = parser.add_argument
    add('recording', type=Path, metavar='BAG', help='with plots or bearings')
    add('--sensor', choices=sorted(SENSORS), default='radar', help='default: radar')
    add('--params', type=parameter_file, required=True, metavar='FILE', help='of the node')
    add('--until', type=positive, default=np.inf, metavar='SECONDS', help='of the recording')
    add('--window', type=float, nargs=3, metavar=('X', 'Y', 'WIDTH'), help='of a closer look [m]')
    add('--output', type=file_to_write, required=True, metavar='PNG', help='picture to write')
    return parser


if __name__ == '__main__':
    sys.exit(main())
