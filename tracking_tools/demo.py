# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
The whole way at once: a recorded scene, the live node, its tracks, a picture.

The node runs as a process of its own, in a ROS domain of its own on this machine alone.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
import shutil
import signal
import sys

from tracking_session.node_config import Configs
from tracking_tools.arguments import positive
from tracking_tools.bags import BadBag
from tracking_tools.demo_player import play
from tracking_tools.demo_report import report
from tracking_tools.node_process import NodeFailed
from tracking_tools.picture import draw
from tracking_tools.presets import parameter_file
from tracking_tools.replay import RADAR, read_configs, replay
from tracking_tools.replay_topics import Topics
from tracking_tools.report import load_page
from tracking_tools.scene import read_scene
from tracking_tools.sensors import SensorKind
from tracking_tools.stopping import STOPPED

ROOT = Path(__file__).parent.parent


@dataclass(frozen=True)
class Demo:
    """What is shown."""

    name: str  # of the results
    sensor: SensorKind
    recording: Path | None  # bag; None: made anew, which `make_recording` does
    make_recording: Callable[[Path], None]
    parameters: Path
    rate: float  # times real time
    finish: Callable[[Path, Path, Path, Configs, Topics, bool], str]
    """Draws a recording and its tracks, ours or another's, and returns what there is to say."""


def main(arguments: Sequence[str] | None = None, demo: Demo | None = None) -> int:
    """Run the command."""
    demo = demo or RADAR_DEMO
    chosen = _parser(demo).parse_args(arguments)
    try:
        show(chosen, demo)
    except KeyboardInterrupt:
        print(f'\n{demo.name}: stopped', file=sys.stderr)
        return STOPPED
    except (BadBag, NodeFailed, OSError, ValueError) as error:
        print(f'{demo.name}: {error}', file=sys.stderr)
        return 1
    return 0


def show(chosen: argparse.Namespace, demo: Demo) -> None:
    """Track the recording, say how well, and draw it."""
    topics = Topics.remapped(chosen.remap, demo.sensor)
    out, name = chosen.output, demo.name
    tracks, picture, recording = out / f'{name}_tracks', out / f'{name}.png', chosen.recording
    page = out / f'{name}.html'
    if out.exists() and not out.is_dir():
        raise FileExistsError(f'{out} is in the way, and is no folder')
    out.mkdir(parents=True, exist_ok=True)
    _remove_bag(tracks)
    if recording is None:
        recording = out / f'{name}_recording'
        _remove_bag(recording)
        demo.make_recording(recording)
    if chosen.live:
        log = out / f'{name}_node.log'
        play(recording, tracks, chosen.params, chosen.rate, log, demo.sensor, topics)
    configs = read_configs(chosen.params, {}, demo.sensor)
    taken: list[float] = []
    if not chosen.live:
        summary = replay(recording, tracks, configs, topics, sensor=demo.sensor)
        taken = summary.step_times
        print(summary)
    print('drawing ...', flush=True)
    is_ours = chosen.recording == demo.recording
    print(demo.finish(recording, tracks, picture, configs, topics, is_ours))
    where = (demo.sensor.kind, topics, recording, tracks)
    try:
        load_page().report_replay(where, configs, taken, page)
    except ModuleNotFoundError as error:
        print(f'no page: {error}')
    else:
        print(f'page:    {page} (open it in a browser, press space)')


def _remove_bag(path: Path) -> None:
    """Make room for a bag; nothing but a bag is removed."""
    if not path.exists():
        return
    if not (path / 'metadata.yaml').is_file():
        raise FileExistsError(f'{path} is in the way, and is not a bag')
    shutil.rmtree(path)


def _parser(demo: Demo) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=demo.name,
        description=f'Play a recorded scene to the live {demo.sensor.node}; draw its tracks.',
    )
    add = parser.add_argument
    add('--output', type=Path, default=Path('output'), metavar='DIR', help='default: output')
    add(
        '--rate',
        type=positive,
        default=demo.rate,
        help=f'times real time (default {demo.rate:g})',
    )
    add('--no-live', dest='live', action='store_false', help='replay instead, without a node')
    add('--recording', type=Path, default=demo.recording, metavar='BAG', help='another scene')
    add('--params', type=parameter_file, default=demo.parameters, metavar='FILE', help='for it')
    add('--remap', action='append', default=[], metavar='FROM:=TO', help='as plots:=/radar/plots')
    return parser


def _finish_radar(
    recording: Path, tracks: Path, picture: Path, configs: Configs, topics: Topics, is_ours: bool
) -> str:
    tracker, node = configs
    scene = read_scene(recording, tracks, topics, tracker.sensor, vars(node.fields))
    draw(scene, picture, TITLE if is_ours else recording.name)
    return report(scene, tracks, topics.tracks, picture)


def _make_nothing(path: Path) -> None:
    raise BadBag(f'there is no recording to play, and none can be made at {path}')


TITLE = 'Radar plots to tracks: real flights in a terminal area'
RADAR_DEMO = Demo(
    name='demo',
    sensor=RADAR,
    recording=ROOT / 'demo' / 'terminal_area',
    make_recording=_make_nothing,
    parameters=ROOT / 'config' / 'terminal_radar.yaml',
    rate=36.0,  # half an hour in fifty seconds
    finish=_finish_radar,
)


def run(demo: Demo) -> int:
    """Run the command, where Ctrl-C is an exception also where a shell switched it off."""
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.default_int_handler)
    if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # which nohup switched off for good
        signal.signal(signal.SIGHUP, signal.default_int_handler)
    return main(demo=demo)


if __name__ == '__main__':
    sys.exit(run(RADAR_DEMO))
