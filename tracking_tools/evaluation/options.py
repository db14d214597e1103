# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""With which options a command says how tracks are judged."""

from __future__ import annotations

import argparse
import math

from tracking_tools.evaluation.judging import Yardstick


def add_yardstick(parser: argparse.ArgumentParser) -> None:
    """Add the options of the yardstick."""
    add = parser.add_argument
    add('--radius', type=_positive, help='match radius [m], default 1000; sonar [deg], 1.5')
    add('--cutoff', type=_positive, help='of GOSPA and OSPA, default: the radius [m or deg]')
    add('--gospa-power', type=_positive, default=2.0, metavar='P', help='default 2')
    add('--ospa-power', type=_positive, default=1.0, metavar='P', help='default 1')
    add('--turning', type=_positive, default=0.8, metavar='RATE',
        help='a course that changes faster is a manoeuvre [deg/s], default 0.8')  # fmt: skip


def yardstick_of(chosen: argparse.Namespace, sensor: str) -> Yardstick:
    """Return what the options say of this sensor's tracks."""
    scale = math.radians(1.0) if sensor == 'sonar' else 1.0
    return Yardstick(
        None if chosen.radius is None else scale * chosen.radius,
        None if chosen.cutoff is None else scale * chosen.cutoff,
        chosen.gospa_power, chosen.ospa_power, math.radians(chosen.turning),
    )  # fmt: skip


def _positive(text: str) -> float:
    number = float(text)
    if not 0.0 < number < math.inf:
        raise argparse.ArgumentTypeError(f'must be above 0, got {text}')
    return number
