# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How a recording becomes tracks without a ROS graph.

Every message goes through the object that the node drives, so the rows are those of the live node.
Time is that of the recording: the same bag and parameters give the same bytes.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
import sys
import time
from typing import Any

from msg_adapters.message_types import rosbags_types
from tracking_session.node_config import Configs
from tracking_session.parameter_blocks import BadParameterFile
from tracking_tools.arguments import file_to_write
from tracking_tools.bags import BadBag, BagWriter, open_bag, POINT_CLOUD
from tracking_tools.parameter_file import configure, parse_value, read_parameter_file
from tracking_tools.presets import parameter_file, PARAMETER_HELP
from tracking_tools.replay_drive import drive
from tracking_tools.replay_topics import check_named, check_topics, Topics
from tracking_tools.report import load_page
from tracking_tools.sensors import SensorKind, SENSORS
from tracking_tools.stopping import stoppable, STOPPED
from tracking_tools.summary import Console, Summary

RADAR = SENSORS['radar']


def replay(
    recording: Path | str,
    output: Path | str,
    configs: Configs | None = None,
    topics: Topics | None = None,
    quiet: bool = False,
    sensor: SensorKind = RADAR,
) -> Summary:
    """
    Write the bag of tracks that the node would have published.

    Parameters
    ----------
    recording : Path or str
        rosbag2 directory with plots.
    output : Path or str
        Directory to make.
    configs : tuple, optional
        Parameters of tracker and node.
    topics : Topics, optional
        Where in the bag the messages are, and where the tracks go.
    quiet : bool
        Without progress and remarks.
    sensor : SensorKind
        What the plots are from.

    Raises
    ------
    FileNotFoundError, FileExistsError
        If there is no bag, or something in the place of the output.
    BadBag
        If the bag cannot be read or has no plots; says what it has.

    """
    topics = topics or Topics.of(sensor)
    configs = configs or sensor.configs
    session = sensor.make_session(*configs, rosbags_types(), Console(quiet))
    summary, began = Summary(session.counts[sensor.topic]), time.perf_counter()
    with open_bag(recording) as bag:
        check_topics(bag, topics, recording)
        check_named(bag, topics, recording)
        with BagWriter(output) as out:
            out.announce(topics.tracks, POINT_CLOUD)
            for answer, received in drive(bag, session, configs[1], topics, quiet):
                out.write(topics.tracks, answer.table, received)
                summary.add(answer.tracks, received)
                summary.step_times.append(answer.taken)
    summary.wall_time = time.perf_counter() - began
    return summary


@stoppable('replay')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = _parser()
    chosen = parser.parse_args(arguments)
    try:
        sensor = SENSORS[chosen.sensor]
        topics = Topics.remapped(chosen.remap, sensor)
        configs = read_configs(chosen.params, dict(map(_setting, chosen.set)), sensor)
    except ValueError as error:
        parser.error(str(error))
    try:
        pages = load_page() if chosen.report is not None else None
        summary = replay(chosen.recording, chosen.output, configs, topics, chosen.quiet, sensor)
    except (BadBag, OSError, ModuleNotFoundError) as error:
        print(f'replay: {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('replay: stopped; nothing was written', file=sys.stderr)
        return STOPPED
    if not chosen.quiet:
        print(f'{summary}\ntracks: {chosen.output}, topic {topics.tracks}')
    try:
        _show(chosen, configs, topics, summary, pages)
    except (BadBag, OSError) as error:
        print(f'replay: no picture or page: {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f'replay: stopped; the tracks are in {chosen.output}', file=sys.stderr)
        return STOPPED
    if summary.unused:
        print(f'replay: no message of {topics.plots} could be used: {summary.unused}',
              file=sys.stderr)  # fmt: skip
        return 1
    return 0


def _show(
    chosen: argparse.Namespace, configs: Configs, topics: Topics, summary: Summary, pages: Any
) -> None:
    """Make the picture and the page that are asked for."""
    if chosen.picture is not None:
        pictures = import_module(SENSORS[chosen.sensor].picture)  # matplotlib is slow to import
        pictures.draw_recording(chosen.recording, chosen.output, topics, configs, chosen.picture)
    if pages is not None:
        where = (chosen.sensor, topics, chosen.recording, chosen.output)
        pages.report_replay(where, configs, summary.step_times, chosen.report)


def read_configs(file: Path | None, settings: Mapping[str, Any], sensor: SensorKind) -> Configs:
    """Return the parameters of a file, if any, and those set beside it, which win."""
    values = {} if file is None else read_parameter_file(file, f'/{sensor.node}')
    return configure(sensor.configs, {**values, **settings})


def _setting(text: str) -> tuple[str, Any]:
    name, equals, value = text.partition('=')
    if not (name and equals and value):
        raise BadParameterFile(f'--set takes name=value, got {text!r}')
    return name.strip(), parse_value(value)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='replay', description='Track a recorded bag with the parameters of a live node.'
    )
    add = parser.add_argument
    add('recording', type=Path, metavar='IN_BAG', help='rosbag2 directory, mcap or sqlite3')
    add('--sensor', choices=SENSORS, required=True, help='what the plots are from')
    add('--params', type=parameter_file, metavar='FILE', help=PARAMETER_HELP)
    add('--set', action='append', default=[], metavar='NAME=VALUE', help='one parameter')
    add('--remap', action='append', default=[], metavar='FROM:=TO', help='as plots:=/radar/plots')
    add('--output', type=Path, required=True, metavar='OUT_BAG', help='rosbag2 directory to make')
    add('--quiet', action='store_true', help='no progress, no remarks, no summary')
    add('--picture', type=file_to_write, metavar='PNG', help='draw what came out')
    add('--report', type=file_to_write, metavar='HTML', help='write a page that shows it')
    return parser


if __name__ == '__main__':
    sys.exit(main())
