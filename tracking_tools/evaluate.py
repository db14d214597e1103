# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How good are the tracks of a recording? The command."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import math
from pathlib import Path
import sys

from rosbags.highlevel import AnyReaderError

from tracking_tools.bags import BadBag
from tracking_tools.evaluation import evaluate, to_json, to_text, Yardstick
from tracking_tools.evaluation.reading import find_sensor
from tracking_tools.sensors import SENSORS


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = _parser()
    chosen = parser.parse_args(arguments)
    try:
        sensor, _ = find_sensor(chosen.tracks, chosen.remap, chosen.sensor)
        scale = math.radians(1.0) if sensor == 'sonar' else 1.0
        yardstick = Yardstick(
            None if chosen.radius is None else scale * chosen.radius,
            None if chosen.cutoff is None else scale * chosen.cutoff,
            chosen.gospa_power, chosen.ospa_power, math.radians(chosen.turning),
        )  # fmt: skip
        truth = chosen.tracks if chosen.truth is None else chosen.truth
        judgement = evaluate(chosen.tracks, truth, yardstick, chosen.remap, sensor)
        if chosen.json is not None:
            chosen.json.parent.mkdir(parents=True, exist_ok=True)
            chosen.json.write_text(to_json(judgement) + '\n')
    except (BadBag, OSError, AnyReaderError) as error:
        print(f'evaluate: {error}', file=sys.stderr)
        return 1
    print(to_text(judgement))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='evaluate', description='Compare recorded tracks with the truth.'
    )
    add = parser.add_argument
    add('tracks', type=Path, metavar='TRACKS_BAG', help='rosbag2 directory with a track table')
    add('--truth', type=Path, metavar='BAG', help='with the truth; default: the same bag')
    add('--json', type=Path, metavar='FILE', help='write all figures there, SI units and radians')
    add('--sensor', choices=SENSORS, help='whose tracks; default: what the bag has')
    add('--remap', action='append', default=[], metavar='FROM:=TO', help='as truth:=/my/truth')
    add('--radius', type=_positive, help='match radius [m], default 1000; sonar [deg], 1.5')
    add('--cutoff', type=_positive, help='of GOSPA and OSPA, default: the radius [m or deg]')
    add('--gospa-power', type=_positive, default=2.0, metavar='P', help='default 2')
    add('--ospa-power', type=_positive, default=1.0, metavar='P', help='default 1')
    add('--turning', type=_positive, default=0.8, metavar='RATE',
        help='a course that changes faster is a manoeuvre [deg/s], default 0.8')  # fmt: skip
    return parser


def _positive(text: str) -> float:
    number = float(text)
    if not 0.0 < number < math.inf:
        raise argparse.ArgumentTypeError(f'must be above 0, got {text}')
    return number


if __name__ == '__main__':
    sys.exit(main())
