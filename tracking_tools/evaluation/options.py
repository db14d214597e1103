# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""With which options a command says how tracks are judged."""

from __future__ import annotations

import argparse
import math

from tracking_tools.arguments import positive
from tracking_tools.evaluation.judging import Yardstick

MOST_POWER = 20.0  # of GOSPA and OSPA
SIZES = (1e-9, 1e9)  # of radius and cutoff [m or deg]: beyond, their powers are no numbers


def add_yardstick(parser: argparse.ArgumentParser) -> None:
    """Add the options of the yardstick."""
    add = parser.add_argument
    add('--radius', type=_size, help='match radius [m], default 1000; sonar [deg], 1.5')
    add('--cutoff', type=_size, help='of GOSPA and OSPA, default: the radius [m or deg]')
    add('--gospa-power', type=_power, default=2.0, metavar='P', help='default 2')
    add('--ospa-power', type=_power, default=1.0, metavar='P', help='default 1')
    add('--turning', type=positive, default=0.8, metavar='RATE',
        help='a course that changes faster is a manoeuvre [deg/s], default 0.8')  # fmt: skip


def yardstick_of(chosen: argparse.Namespace, sensor: str) -> Yardstick:
    """Return what the options say of this sensor's tracks."""
    scale = math.radians(1.0) if sensor == 'sonar' else 1.0
    return Yardstick(
        None if chosen.radius is None else scale * chosen.radius,
        None if chosen.cutoff is None else scale * chosen.cutoff,
        chosen.gospa_power, chosen.ospa_power, math.radians(chosen.turning),
    )  # fmt: skip


def _size(text: str) -> float:
    """Return a radius or cutoff."""
    number = positive(text)
    if not SIZES[0] <= number <= SIZES[1]:
        raise argparse.ArgumentTypeError(f'must be from {SIZES[0]:g} to {SIZES[1]:g}, got {text}')
    return number


def _power(text: str) -> float:
    """Return the order of a metric: below 1 it is none, far above distances overflow."""
    number = positive(text)
    if not 1.0 <= number <= MOST_POWER:
        raise argparse.ArgumentTypeError(f'must be from 1 to {MOST_POWER:g}, got {text}')
    return number
