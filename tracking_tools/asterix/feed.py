# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How reports become messages of plots, and where their bytes come from."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
import socket
from typing import Any
from urllib.parse import urlsplit

import numpy as np

from msg_adapters.message_types import MessageTypes
from msg_adapters.table import from_columns
from tracking_tools.asterix.blocks import data_blocks, HEADER, read_reports, Report
from tracking_tools.asterix.clock import DayClock

LARGEST = 65_535  # bytes of a datagram, and of a block
PATIENCE = 0.2  # between two looks at whether to go on [s]


def from_file(path: Path, counts: Counter[str]) -> Iterator[bytes]:
    """Yield the data blocks of a file, one after another."""
    for category, body in data_blocks(path.read_bytes(), counts):
        yield bytes([category]) + (len(body) + HEADER).to_bytes(2, 'big') + body


def open_udp(address: str) -> socket.socket:
    """
    Return a socket that hears 'udp://HOST:PORT'; a multicast group is joined.

    Raises
    ------
    ValueError
        For another form of address.

    """
    parts = urlsplit(address)
    if parts.scheme != 'udp' or not parts.hostname or parts.port is None:
        raise ValueError(f'address must be udp://HOST:PORT, got {address}')
    hearing = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    hearing.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    hearing.bind((parts.hostname, parts.port))
    group = socket.inet_aton(socket.gethostbyname(parts.hostname))
    if 224 <= group[0] < 240:
        request = group + socket.inet_aton('0.0.0.0')
        hearing.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, request)
    hearing.settimeout(PATIENCE)
    return hearing


class Feed:
    """
    Makes messages of plots from one radar's reports.

    Parameters
    ----------
    types : MessageTypes
        Classes of the messages.
    frame : str
        Of the header: east, north, up at the radar.
    reference : float
        Some time less than half a day from the first report [s since the epoch].
    source : tuple of int, optional
        SAC and SIC; without it the first report says whose reports are used.
    with_doppler : bool
        Whether the Doppler speed is told; its sign is not the same for all radars.

    """

    def __init__(
        self,
        types: MessageTypes,
        frame: str,
        reference: float,
        source: tuple[int, int] | None = None,
        with_doppler: bool = False,
    ) -> None:
        self.counts: Counter[str] = Counter()
        self.source = source
        self._types, self._frame, self._with_doppler = types, frame, with_doppler
        self.clock = DayClock(reference)

    def message(self, data: bytes) -> tuple[float, Any] | None:
        """Return time [s] and message (PointCloud2) of a datagram, None if it has no reports."""
        reports = [r for r in read_reports(data, self.counts) if self._is_ours(r)]
        if not reports:
            return None
        times = np.array([self.clock.time(report.time_of_day) for report in reports])
        plots = [(t, r) for t, r in zip(times, reports, strict=True) if np.isfinite(r.range)]
        stamp = float(times.min())
        self.counts['plots'] += len(plots)
        return stamp, from_columns(self._columns(plots, stamp), stamp, self._frame, self._types)

    def messages(self, chunks: Iterable[bytes]) -> Iterator[tuple[float, Any]]:
        """Yield time [s] and message of everything that has reports."""
        for chunk in chunks:
            told = self.message(chunk)
            if told is not None:
                yield told

    def _is_ours(self, report: Report) -> bool:
        self.source = self.source or report.source
        if report.source != self.source:
            self.counts[f'from radar {report.source[0]}/{report.source[1]}'] += 1
        return report.source == self.source

    def _columns(self, plots: Sequence[tuple[float, Report]], stamp: float) -> dict[str, Any]:
        def column(name: str) -> Any:
            return np.array([getattr(report, name) for _, report in plots], np.float32)

        return {
            'range': column('range'),
            'azimuth': column('azimuth'),
            'time': np.array([time - stamp for time, _ in plots], np.float32),
            'amplitude': column('amplitude'),
            **({'range_rate': column('doppler')} if self._with_doppler else {}),
            'id': np.array([report.track for _, report in plots], np.uint32),
        }


def describe(feed: Feed) -> str:
    """Return what became of the reports, in words."""
    source = 'none' if feed.source is None else f'{feed.source[0]}/{feed.source[1]}'
    counts = ', '.join(f'{name} {count}' for name, count in sorted(feed.counts.items()))
    return f'radar {source}: {counts or "nothing"}'
