# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The command of every feed: a file or UDP in, plots published live or written to a bag."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from importlib import import_module
from pathlib import Path
import sys
import time
from typing import Any

from msg_adapters.message_types import rclpy_types, rosbags_types
from tracking_tools.arguments import day, not_negative, positive
from tracking_tools.feeds.captures import datagrams_of_capture, is_capture
from tracking_tools.feeds.feed import describe, Feed, Read
from tracking_tools.feeds.sources import open_udp


@dataclass(frozen=True)
class Format:
    """What is special about a format."""

    name: str
    library: str  # as pip calls it
    is_available: Callable[[], bool]
    reader: Callable[[argparse.Namespace], Read]  # from the options to a decoder
    chunks: Callable[[Path, Counter[str]], Iterator[bytes]]  # of a file
    add_options: Callable[[Any], None]
    interval: float = 0.0  # as of `Feed` [s]


def run(kind: Format, arguments: Sequence[str] | None = None) -> int:
    """Run the command of a format; return its exit code."""
    given, ros = list(sys.argv[1:] if arguments is None else arguments), []
    if '--ros-args' in given:
        at = given.index('--ros-args')
        given, ros = given[:at], given[at:]
    chosen = _parser(kind).parse_args(given)
    if not kind.is_available():
        needed = f'{kind.name}: needs the package {kind.library}: pip install {kind.library}'
        print(needed, file=sys.stderr)
        return 1
    try:
        return _run(kind, chosen, ros)
    except (OSError, ValueError) as error:
        print(f'{kind.name}: {error}', file=sys.stderr)
        return 1


def _run(kind: Format, chosen: argparse.Namespace, ros: list[str]) -> int:
    is_live, is_udp = chosen.bag is None, '://' in chosen.source
    if is_udp and not is_live:
        raise ValueError('--bag is for a file; record a live feed with ros2 bag record plots')
    path = Path(chosen.source)
    reference = time.time() if is_udp else _reference(path, chosen.date)
    feed = Feed(
        kind.reader(chosen), rclpy_types() if is_live else rosbags_types(), chosen.frame,
        reference, chosen.interval, getattr(chosen, 'radar', None),
        getattr(chosen, 'doppler', False), getattr(chosen, 'height', None) is not None,
    )  # fmt: skip
    if is_live:
        live = import_module('tracking_tools.feeds.node')  # needs rclpy
        chunks = open_udp(chosen.source) if is_udp else _chunks(kind, path, feed.counts)
        live.publish(kind.name, feed, chunks, ros, chosen.rate)
        return 0 if is_udp or feed.told else 1
    _write_bag(feed, _chunks(kind, path, feed.counts), path, chosen.bag)
    print(f'{chosen.bag}: {describe(feed)}')
    return 0


def _chunks(kind: Format, path: Path, counts: Counter[str]) -> Iterator[bytes]:
    """Return the datagrams of a capture, the parts of any other file."""
    chunks = datagrams_of_capture if is_capture(path) else kind.chunks
    return chunks(path, counts)


def _write_bag(feed: Feed, chunks: Iterator[bytes], path: Path, bag: Path) -> None:
    """Write the plots of a file as a bag with the topic ``plots``."""
    bags = import_module('tracking_tools.bags')
    with bags.BagWriter(bag) as out:
        out.announce('plots', 'sensor_msgs/msg/PointCloud2')
        for stamp, msg in feed.messages(chunks):
            out.write('plots', msg, bags.nanoseconds(stamp))
        if not feed.told:
            raise ValueError(f'{path} gives no message; {describe(feed)}')


def _reference(path: Path, date: datetime | None) -> float:
    """Return noon of the day that the user says, or when the file was written [s]."""
    if date is not None:
        return date.replace(hour=12, tzinfo=timezone.utc).timestamp()
    return path.stat().st_mtime


def _parser(kind: Format) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=kind.name, description=f'{kind.name} to plots, live or into a bag.'
    )
    add = parser.add_argument
    add('source', metavar='FILE|udp://HOST:PORT', help='a recording, or a UDP feed')
    add('--bag', type=Path, metavar='OUT', help='write a bag instead of publishing')
    add('--date', type=day, metavar='YYYY-MM-DD', help='day (UTC) on which a '
        'file begins; without it: when it was written')  # fmt: skip
    add('--frame', default='radar', help='frame_id: east, north, up at the sensor')
    add('--interval', type=not_negative, default=kind.interval, metavar='SECONDS',
        help='reports so near in time are one message; 0: a datagram or block is one')  # fmt: skip
    add('--rate', type=positive, default=1.0, help='times real time, for a file')
    kind.add_options(add)
    return parser


def origin_option(add: Any) -> None:
    """Add where the sensor is, for formats with geographic positions."""
    add('--origin', type=float, nargs=2, metavar=('LAT', 'LON'), help='of the frame, WGS 84 [deg]')


def origin_of(chosen: argparse.Namespace) -> tuple[float, float] | None:
    """Return where the sensor is [deg], None if it was not said; ValueError for no place."""
    if chosen.origin is None:
        return None
    latitude, longitude = chosen.origin
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0):
        raise ValueError(
            '--origin must be LAT in [-90, 90] and LON in [-180, 180] deg, got '
            f'{latitude:g} {longitude:g}'
        )
    return latitude, longitude
