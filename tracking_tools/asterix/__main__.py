# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of an ASTERIX CAT048 file or UDP feed, published live or written to a bag."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys
from typing import Any

from tracking_tools.arguments import finite
from tracking_tools.asterix.blocks import blocks_of_file, is_available, loaded_reader
from tracking_tools.feeds.command import Format, run
from tracking_tools.stopping import stoppable


@stoppable('asterix')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    return run(ASTERIX, arguments)


def _options(add: Any) -> None:
    add('--radar', type=_radar, metavar='SAC/SIC', help='default: that of the first report')
    add('--height', type=finite, metavar='METRES', help='of the radar above the sea: plots with '
        'a flight level or a height are 3-D')  # fmt: skip
    add('--doppler', action='store_true', help='publish the Doppler speed as range_rate; mind '
        'sensor.range_rate_sign')  # fmt: skip


def _radar(text: str) -> tuple[int, int]:
    sac, sign, sic = text.partition('/')
    if not sign or not (sac.isdigit() and sic.isdigit()):
        raise argparse.ArgumentTypeError(f'must be SAC/SIC, such as 25/201, got {text}')
    return int(sac), int(sic)


ASTERIX = Format(
    name='asterix',
    library='libasterix',
    is_available=is_available,
    reader=lambda chosen: loaded_reader(chosen.height),
    chunks=blocks_of_file,
    add_options=_options,
)

if __name__ == '__main__':
    sys.exit(main())
