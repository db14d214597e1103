# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a named scenario becomes a bag, or is published live."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
import sys
import time

from tqdm import tqdm

from msg_adapters.message_types import LATEST, rosbags_types
from tracking_tools.arguments import positive, seed
from tracking_tools.bags import BagWriter, nanoseconds
from tracking_tools.scenarios.broadcast import broadcast, Scene
from tracking_tools.scenarios.menu import build_any, SCENES
from tracking_tools.scenarios.messages import EPOCH, TRUTH
from tracking_tools.stopping import stoppable


def record(
    scene: Scene,
    path: Path | str,
    sectors: int = 1,
    compress: bool = False,
    quiet: bool = False,
) -> dict[str, int]:
    """
    Write the bag of a scene: the same scene gives the same bytes.

    Parameters
    ----------
    scene : Scenario or Watch
        What happens.
    path : Path or str
        Directory to make.
    sectors : int
        ``plots`` messages in a turn of a radar.
    compress : bool
        Whether to compress the storage.
    quiet : bool
        Without progress.

    Returns
    -------
    dict
        Rows written on each topic; messages where they have no rows.

    """
    air = broadcast(scene, sectors)
    rows = dict.fromkeys(air.types, 0)
    lists = air.messages(rosbags_types(), EPOCH)
    with BagWriter(path, compress) as bag:
        for topic, kind in air.types.items():
            bag.announce(topic, kind)
        for sent in tqdm(lists, 'simulate', air.count, unit='msg', disable=quiet or None):
            for topic, msg, time in sent:
                bag.write(topic, msg, nanoseconds(EPOCH + time))
                rows[topic] += getattr(msg, 'width', 1)
    return rows


@stoppable('simulate')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = _parser()
    options, ros_arguments = _split(sys.argv[1:] if arguments is None else list(arguments))
    chosen = parser.parse_args(options)
    if chosen.list:
        print('\n'.join(f'{name:18} {build_any(name).description}' for name in SCENES))
        return 0
    if chosen.scenario is None or (chosen.output is None) == (not chosen.live):
        parser.error('give a scenario and either --output BAG or --live; --list shows them all')
    try:
        scene = _changed(build_any(chosen.scenario), chosen)
        if chosen.live:
            publisher = import_module('tracking_tools.publisher')  # needs rclpy, the rest does not
            publish = publisher.publish
            return int(publish(scene, ros_arguments, chosen.sectors, chosen.rate, chosen.wait))
        rows = record(scene, chosen.output, chosen.sectors, chosen.compress)
    except (ValueError, OSError, MemoryError) as error:
        parser.error(str(error))
    topic = broadcast(scene).topic
    print(f'{chosen.output}: {scene.description}; {rows[topic]} {topic}, {rows[TRUTH]} true rows')
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='simulate', description=__doc__)
    add = parser.add_argument
    add('scenario', nargs='?', metavar='SCENARIO', help='name; --list shows them')
    add('--list', action='store_true', help='list the scenarios')
    add('--output', type=Path, metavar='BAG', help='rosbag2 directory to write')
    add('--compress', action='store_true', help='compress the bag (zstd)')
    add('--seed', type=seed, help='of the random numbers')
    add('--duration', type=positive, metavar='S', help='how long the sensor runs [s]')
    add('--sectors', type=int, default=1, metavar='N', help='messages in a turn (default 1)')
    add('--live', action='store_true', help='publish instead of writing a bag')
    add('--rate', type=float, default=1.0, help='live: times real time (default 1)')
    add('--wait', action='store_true', help='live: begin when somebody listens')
    return parser


def _split(arguments: list[str]) -> tuple[list[str], list[str]]:
    """Take ``--ros-args ...`` apart from the rest."""
    cut = arguments.index('--ros-args') if '--ros-args' in arguments else len(arguments)
    return arguments[:cut], arguments[cut:]


def _changed(scene: Scene, chosen: argparse.Namespace) -> Scene:
    begin = time.time() if chosen.live else EPOCH
    if chosen.duration is not None and begin + chosen.duration > LATEST:
        raise ValueError(
            f'duration must be at most {LATEST - begin:.0f} s, when the stamps of messages end, '
            f'got {chosen.duration:g}'
        )
    wanted = {name: getattr(chosen, name) for name in ('seed', 'duration')}
    return replace(scene, **{k: v for k, v in wanted.items() if v is not None})


if __name__ == '__main__':
    sys.exit(main())
