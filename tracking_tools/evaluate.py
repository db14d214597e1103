# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How good are the tracks of a recording? The command."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
import sys

from rosbags.highlevel import AnyReaderError

from tracking_tools.arguments import file_to_write, make_folder
from tracking_tools.bags import BadBag
from tracking_tools.evaluation import evaluate, to_json, to_text
from tracking_tools.evaluation.options import add_yardstick, yardstick_of
from tracking_tools.evaluation.reading import find_sensor
from tracking_tools.sensors import SENSORS
from tracking_tools.stopping import stoppable
from tracking_tools.sweep import main as sweep


@stoppable('evaluate')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; many runs of a scenario are a sweep without settings."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    if any(word.split('=')[0] == '--runs' for word in given):
        return sweep(given)
    chosen = _parser().parse_args(given)
    try:
        truth = chosen.tracks if chosen.truth is None else chosen.truth
        sensor, _ = find_sensor(chosen.tracks, chosen.remap, chosen.sensor)
        yardstick = yardstick_of(chosen, sensor)
        judgement = evaluate(chosen.tracks, truth, yardstick, chosen.remap, sensor)
        if chosen.json is not None:
            make_folder(chosen.json.parent)
            chosen.json.write_text(to_json(judgement) + '\n')
    except (BadBag, OSError, AnyReaderError) as error:
        print(f'evaluate: {error}', file=sys.stderr)
        return 1
    print(to_text(judgement))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='evaluate',
        description='Compare recorded tracks with the truth.',
        epilog='evaluate SCENARIO --runs N --output DIR: many runs; options as of sweep.',
    )
    add = parser.add_argument
    add('tracks', type=Path, metavar='TRACKS_BAG', help='rosbag2 directory with a track table')
    add('--truth', type=Path, metavar='BAG', help='with the truth; default: the same bag')
    add(
        '--json',
        type=file_to_write,
        metavar='FILE',
        help='write all figures there, SI units and radians',
    )
    add('--sensor', choices=SENSORS, help='whose tracks; default: what the bag has')
    add('--remap', action='append', default=[], metavar='FROM:=TO', help='as truth:=/my/truth')
    add_yardstick(parser)
    return parser


if __name__ == '__main__':
    sys.exit(main())
