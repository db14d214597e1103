# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ships that report by AIS as plots, published live or written to a bag."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial
from importlib.util import find_spec
import sys

from tracking_tools.ais.sentences import read_positions
from tracking_tools.feeds.command import Format, origin_of, origin_option, run
from tracking_tools.feeds.feed import Read
from tracking_tools.feeds.sources import lines_of_file
from tracking_tools.stopping import stoppable


@stoppable('ais')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    return run(AIS, arguments)


def _reader(chosen: argparse.Namespace) -> Read:
    origin = origin_of(chosen)
    if origin is None:
        raise ValueError('--origin LAT LON must say where the frame is')
    return partial(read_positions, origin=origin)


AIS = Format(
    name='ais',
    library='pyais',
    is_available=lambda: find_spec('pyais') is not None,
    reader=_reader,
    chunks=lines_of_file,
    add_options=origin_option,
    interval=12.0,  # ships on the way report every 10 s at the latest, most of them
)

if __name__ == '__main__':
    sys.exit(main())
