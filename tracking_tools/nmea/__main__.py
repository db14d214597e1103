# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Targets of a marine radar (NMEA TTM, TLL) as plots, published live or written to a bag."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial
from importlib.util import find_spec
import sys
from typing import Any

from tracking_tools.feeds.command import Format, origin_of, origin_option, run
from tracking_tools.feeds.feed import Read
from tracking_tools.feeds.sources import lines_of_file
from tracking_tools.nmea.sentences import read_sentences
from tracking_tools.stopping import stoppable


@stoppable('nmea')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    return run(NMEA, arguments)


def _options(add: Any) -> None:
    origin_option(add)
    add('--relative', action='store_true', help="bearings from ahead, in the ship's frame")


def _reader(chosen: argparse.Namespace) -> Read:
    return partial(read_sentences, origin=origin_of(chosen), relative=chosen.relative)


NMEA = Format(
    name='nmea',
    library='pynmea2',
    is_available=lambda: find_spec('pynmea2') is not None,
    reader=_reader,
    chunks=lines_of_file,
    add_options=_options,
    interval=2.0,
)

if __name__ == '__main__':
    sys.exit(main())
