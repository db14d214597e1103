# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a recording becomes a page: the command."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
import sys

from rosbags.highlevel import AnyReaderError

from tracking_tools.arguments import file_to_write
from tracking_tools.evaluation.options import add_yardstick, yardstick_of
from tracking_tools.evaluation.reading import find_sensor
from tracking_tools.presets import parameter_file
from tracking_tools.replay import read_configs
from tracking_tools.report import load_page
from tracking_tools.report.material import gather, Sources
from tracking_tools.sensors import SENSORS
from tracking_tools.stopping import stoppable


@stoppable('report')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    chosen = _parser().parse_args(arguments)
    try:
        kind, topics = find_sensor(chosen.tracks, chosen.remap, chosen.sensor)
        configs = read_configs(chosen.params, {}, SENSORS[kind]) if chosen.params else None
        sources = Sources(kind, topics, chosen.tracks, chosen.plots, chosen.truth)
        yardstick = yardstick_of(chosen, kind)
        material = gather(sources, configs, yardstick=yardstick, title=chosen.title)
        load_page().write_page(material, chosen.output)
    except (ValueError, OSError, AnyReaderError, ModuleNotFoundError) as error:
        print(f'report: {error}', file=sys.stderr)
        return 1
    print(f'{chosen.output}: open it in a browser')
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='report', description='Show a recording in one page for any browser.'
    )
    add = parser.add_argument
    add('tracks', type=Path, metavar='TRACKS_BAG', help='rosbag2 directory with a track table')
    add('--plots', type=Path, metavar='BAG', help='with the plots or bearings')
    add('--truth', type=Path, metavar='BAG', help='with the truth')
    add('--output', type=file_to_write, required=True, metavar='HTML', help='page to write')
    add('--params', type=parameter_file, metavar='FILE', help='what the tracks were made with')
    add('--sensor', choices=SENSORS, help='whose tracks; default: what the bag has')
    add('--remap', action='append', default=[], metavar='FROM:=TO', help='as plots:=/radar/plots')
    add('--title', default='', help='of the page; default: the name of the tracks bag')
    add_yardstick(parser)
    return parser
