# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of an ASTERIX CAT048 file or UDP feed, published live or written to a bag."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from datetime import datetime, timezone
from importlib import import_module
from pathlib import Path
import sys
import time

from msg_adapters.message_types import rclpy_types, rosbags_types
from tracking_tools.asterix.blocks import is_available
from tracking_tools.asterix.feed import describe, Feed, from_file, open_udp


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    ours, mark, ros = given, '', []
    if '--ros-args' in given:
        at = given.index('--ros-args')
        ours, mark, ros = given[:at], '--ros-args', given[at + 1 :]
    chosen = _parser().parse_args(ours)
    if not is_available():
        print('asterix: needs the package libasterix: pip install libasterix', file=sys.stderr)
        return 1
    try:
        return _run(chosen, [mark, *ros] if mark else [])
    except (OSError, ValueError) as error:
        print(f'asterix: {error}', file=sys.stderr)
        return 1


def _run(chosen: argparse.Namespace, ros: list[str]) -> int:
    is_live, is_udp = chosen.bag is None, '://' in chosen.source
    if is_udp and not is_live:
        raise ValueError('--bag is for a file; record a live feed with ros2 bag record plots')
    reference = time.time() if is_udp else _reference(Path(chosen.source), chosen.date)
    types = rclpy_types() if is_live else rosbags_types()
    feed = Feed(types, chosen.frame, reference, chosen.radar, chosen.doppler)
    chunks = open_udp(chosen.source) if is_udp else from_file(Path(chosen.source), feed.counts)
    if is_live:
        live = import_module('tracking_tools.asterix.node')  # needs rclpy
        return int(live.publish(feed, chunks, ros, chosen.rate))
    write_bag(feed, Path(chosen.source), chosen.bag)
    print(f'{chosen.bag}: {describe(feed)}')
    return 0


def write_bag(feed: Feed, path: Path, bag: Path) -> None:
    """Write the plots of a file as a bag with the topic ``plots``."""
    bags = import_module('tracking_tools.bags')
    with bags.BagWriter(bag) as out:
        out.announce('plots', 'sensor_msgs/msg/PointCloud2')
        for stamp, msg in feed.messages(from_file(path, feed.counts)):
            out.write('plots', msg, bags.nanoseconds(stamp))


def _reference(path: Path, date: datetime | None) -> float:
    """Return noon of the day that the user says, or when the file was written [s]."""
    if date is not None:
        return date.replace(hour=12, tzinfo=timezone.utc).timestamp()
    return path.stat().st_mtime


def _radar(text: str) -> tuple[int, int]:
    sac, sign, sic = text.partition('/')
    if not sign or not (sac.isdigit() and sic.isdigit()):
        raise argparse.ArgumentTypeError(f'must be SAC/SIC, such as 25/201, got {text}')
    return int(sac), int(sic)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='asterix', description='ASTERIX CAT048 to plots, live or into a bag.'
    )
    add = parser.add_argument
    add('source', metavar='FILE|udp://HOST:PORT', help='data blocks in a row, or a UDP feed')
    add('--bag', type=Path, metavar='OUT', help='write a bag instead of publishing')
    add('--date', type=datetime.fromisoformat, metavar='YYYY-MM-DD', help='day (UTC) on which a '
        'file begins; without it: when it was written')  # fmt: skip
    add('--radar', type=_radar, metavar='SAC/SIC', help='default: that of the first report')
    add('--frame', default='radar', help='frame_id: east, north, up at the radar')
    add('--doppler', action='store_true', help='publish the Doppler speed as range_rate; mind '
        'sensor.range_rate_sign')  # fmt: skip
    add('--rate', type=float, default=1.0, help='times real time, for a file')
    return parser


if __name__ == '__main__':
    sys.exit(main())
