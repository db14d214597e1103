# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which reports are in the bytes of ASTERIX data blocks: monoradar plots of CAT048, marks of CAT034.

Decoding is libasterix's; here it is bounded, and whatever the bytes are, what cannot be read is
counted. Times are those of day, as sent.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache, partial
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
import re
from typing import Any

import numpy as np

from tracking_tools.asterix.heights import elevation_of
from tracking_tools.asterix.items import number, optional, part, quantity
from tracking_tools.feeds.clock import DAY
from tracking_tools.feeds.report import NAUTICAL_MILE, Report

HEADER = 3  # bytes: category, length of the block with its header
MOST = 2000  # records of a block; a block that has more is read so far
PLOTS, SERVICE = 48, 34  # categories
_START = re.compile(bytes([ord('['), PLOTS, SERVICE, ord(']')]))  # of a block of ours
NO_DETECTION = 0  # in I048/020
_MARKS = (1, 2)  # in I034/000: north, sector crossing


def data_blocks(data: bytes, counts: Counter[str]) -> Iterator[tuple[int, bytes]]:
    """Yield category and records of each block; what is damaged is passed over."""
    at = 0
    while at < len(data):
        end = _end(data, at)
        if end and (data[at] in (PLOTS, SERVICE) or _goes_on(data, end)):
            yield data[at], data[at + HEADER : end]
        else:
            counts['truncated or of wrong length'] += 1
            end = _next(data, at + 1)
        at = end


def _end(data: bytes, at: int) -> int:
    """Return where the block that begins here ends, 0 if it cannot be one."""
    length = int.from_bytes(data[at + 1 : at + HEADER], 'big')
    return at + length if HEADER < length <= len(data) - at else 0


def _next(data: bytes, at: int) -> int:
    """Return where the next of our blocks begins that another one, or the end, comes after."""
    for start in _START.finditer(data, at):
        end = _end(data, start.start())
        if end and _goes_on(data, end):
            return start.start()
    return len(data)


def _goes_on(data: bytes, at: int) -> bool:
    """Return whether the data end here, or another block can begin."""
    return at == len(data) or _end(data, at) > 0


def blocks_of_file(path: Path, counts: Counter[str]) -> Iterator[bytes]:
    """Yield the data blocks of a file, one after another."""
    for category, body in data_blocks(path.read_bytes(), counts):
        yield bytes([category]) + (len(body) + HEADER).to_bytes(2, 'big') + body


def read_reports(data: bytes, counts: Counter[str], height: float | None = None) -> list[Report]:
    """
    Return the plots and antenna marks in a chain of data blocks.

    Parameters
    ----------
    data : bytes
        One datagram, or a part of a file.
    counts : Counter
        By reason, what was left out.
    height : float, optional
        Of the radar above the sea [m]; heights of plots become elevations with it.

    """
    reports = []
    for category, body in data_blocks(data, counts):
        if category not in (PLOTS, SERVICE):
            counts[f'category {category}'] += 1
            continue
        to_report = partial(_to_plot, height=height) if category == PLOTS else _to_mark
        for record in _records(category, body, counts):
            report, why = to_report(record)
            if report is None:
                counts[why] += 1
            else:
                reports.append(report)
    return reports


def is_available() -> bool:
    """Return whether libasterix is installed; others bring a package of the same name."""
    try:
        return find_spec('asterix.generated') is not None
    except ModuleNotFoundError:
        return False


def loaded_reader(height: float | None = None) -> Callable[[bytes, Counter[str]], list[Report]]:
    """Return `read_reports` with its library loaded, so that the first datagram need not wait."""
    _library()
    return partial(read_reports, height=height)


@cache
def _library() -> tuple[Any, dict[int, Any]]:
    """Return libasterix and its records by category; a second of work, so only when needed."""
    generated = import_module('asterix.generated')
    records = {
        PLOTS: generated.Cat_048_1_32.cv_record, SERVICE: generated.Cat_034_1_29.cv_record
    }  # fmt: skip
    return import_module('asterix.base'), records


def _records(category: int, body: bytes, counts: Counter[str]) -> Iterator[Any]:
    base, kinds = _library()
    rest, strict = base.Bits.from_bytes(body), base.ParsingMode.StrictParsing
    for _ in range(MOST):
        if not len(rest):
            return
        result = kinds[category].parse(strict, rest)
        if isinstance(result, ValueError):
            counts['damaged record'] += 1
            return
        record, rest = result
        yield record
    counts[f'records beyond {MOST} of a block'] += 1


def _to_plot(record: Any, height: float | None) -> tuple[Report | None, str]:
    """Return the plot, or None and why it is none."""
    kind = record.get_item('020')
    if kind is not None and number(kind, 'TYP') == NO_DETECTION:
        return None, 'no detection'
    if kind is not None and (number(kind, 'SIM') or number(kind, 'TST')):
        return None, 'simulated or test target'
    source, time, place = (record.get_item(name) for name in ('010', '140', '040'))
    if source is None or time is None or place is None:
        return None, 'without source, time or position'
    if quantity(time, 's') >= DAY:
        return None, 'time beyond the day'
    theta = quantity(part(place, 'THETA'), '°')
    distance = quantity(part(place, 'RHO'), 'NM') * NAUTICAL_MILE
    elevation, elevation_sd = elevation_of(record, distance, height)
    track = record.get_item('161')
    report = Report(
        source=(number(source, 'SAC'), number(source, 'SIC')),
        time_of_day=quantity(time, 's'),
        range=distance,
        azimuth=np.pi / 2.0 - np.radians(theta),
        doppler=optional(record, '120', ('CAL', 'CAL'), 'm/s'),
        amplitude=optional(record, '130', ('PAM',), 'dBm'),
        track=None if track is None else number(track, 'TRN'),
        elevation=elevation,
        elevation_sd=elevation_sd,
    )
    return report, ''


def _to_mark(record: Any) -> tuple[Report | None, str]:
    """Return where the antenna was, or None and why nobody knows."""
    source, kind, time = (record.get_item(name) for name in ('010', '000', '030'))
    if source is None or time is None or kind is None or kind.as_uint() not in _MARKS:
        return None, 'service message without antenna'
    if quantity(time, 's') >= DAY:
        return None, 'time beyond the day'
    return Report((number(source, 'SAC'), number(source, 'SIC')), quantity(time, 's')), ''
