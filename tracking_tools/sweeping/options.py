# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What can be asked of a sweep?"""

from __future__ import annotations

import argparse
from pathlib import Path

from tracking_tools.arguments import count, file_to_write, positive
from tracking_tools.evaluation.options import add_yardstick
from tracking_tools.presets import parameter_file, PARAMETER_HELP
from tracking_tools.sensors import SENSORS
from tracking_tools.sweeping.crew import cores
from tracking_tools.sweeping.figures import SHOWN


def sweep_parser() -> argparse.ArgumentParser:
    """Return the parser of the command."""
    parser = argparse.ArgumentParser(
        prog='sweep', description='Track scenarios or recordings with many settings; judge them.'
    )
    add = parser.add_argument
    add(
        'sources',
        nargs='+',
        metavar='SCENARIO|BAG',
        help='names as of simulate, or bags with truth',
    )
    add('--set', action='append', default=[], metavar='NAME=V1,V2', help='values of a parameter')
    add('--runs', type=count, default=1, metavar='N', help='of each scenario, seeds 1 to N')
    add('--output', type=Path, required=True, metavar='DIR', help='kept, and gone on with')
    add('--sensor', choices=SENSORS, default='radar', help='default radar')
    add('--params', type=parameter_file, metavar='FILE', help=PARAMETER_HELP)
    add('--remap', action='append', default=[], metavar='FROM:=TO',
        help='topics of recordings, as plots:=/radar/plots')  # fmt: skip
    add('--truth', type=Path, metavar='BAG', help='of the one recording, where another bag has it')
    add('--duration', type=positive, metavar='S', help='of the scenarios [s]')
    add('--jobs', type=count, default=cores(), metavar='N', help='processes; default: all cores')
    add('--dask', metavar='ADDRESS', help='of a Dask scheduler whose workers do it instead')
    add(
        '--picture',
        type=file_to_write,
        metavar='PNG',
        help='draw a figure over the first parameter',
    )
    add('--figure', choices=SHOWN, default='gospa', help='which, default gospa')
    add('--quiet', action='store_true', help='no progress')
    add_yardstick(parser)
    return parser
