# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the reports of one sender become messages of plots."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from msg_adapters.message_types import MessageTypes
from msg_adapters.table import from_columns
from tracking_tools.feeds.clock import DayClock
from tracking_tools.feeds.report import Report

Read = Callable[[bytes, Counter[str]], Sequence[Report]]
Told = tuple[float, Any]  # time [s] and message (PointCloud2)
MINUTE = 60.0  # s
HEIGHT = ('elevation', 'elevation_sd')
# Half of ASTERIX's unit of time, so much is a stamp before the first report: all plots then tell
# times of their own, where one plot at the stamp of its message could be a sector without times.
AHEAD = 1.0 / 256.0  # s
APART = 1e-6  # between stamps of messages whose first reports are of one time [s]
_STAMPS, _REPORTS = 1000, 10_000  # that are remembered; a thousand of APART are less than AHEAD
_CREDIBLE = 5.0  # as the age of a report that tells the second only [s]; some have wrong clocks
_COPY = 5.0  # after a report another one that is all the same is its copy, live [s]


class Feed:
    """
    Makes messages of plots from one sender's reports.

    Parameters
    ----------
    read : callable
        Returns the reports in a piece of data; counts by reason what it leaves out.
    types : MessageTypes
        Classes of the messages.
    frame : str
        Of the header: east, north, up at the sensor.
    reference : float
        Some time less than half a day from the first report [s since the epoch].
    interval : float
        Reports so near in time are one message [s]; 0: a piece of data is one message.
    source : optional
        Whose reports are used; without it those of the first.
    with_doppler : bool
        Whether the Doppler speed is told; its sign is not the same for all radars.
    with_height : bool
        Whether elevations are told, NaN where a plot has none.

    """

    def __init__(
        self,
        read: Read,
        types: MessageTypes,
        frame: str,
        reference: float,
        interval: float = 0.0,
        source: tuple[int, int] | str | None = None,
        with_doppler: bool = False,
        with_height: bool = False,
    ) -> None:
        self.counts: Counter[str] = Counter()
        self.clock, self.source, self._read = DayClock(reference), source, read
        self._types, self._frame = types, frame
        self._with_doppler, self._with_height = with_doppler, with_height
        self._interval = interval
        self.told = 0  # messages
        self._waiting: list[tuple[float, Report]] = []  # with their times [s]
        self._since = np.nan  # when the first of these came [s]
        self._begun: deque[float] = deque(maxlen=_STAMPS)  # first reports of messages [s]
        self._heard: dict[tuple[float, str], float] = {}  # when reports came [s], oldest first

    def take(self, data: bytes, now: float = np.nan) -> Told | None:
        """
        Return the next message, if this piece of data ends one; `now` [s] is when it came.

        Reports without a time of their own have that one, else that of their tags, and are left
        out without either.
        """
        sent = filter(self._is_ours, self._read(data, self.counts))
        timed = [(self._time(report, now), report) for report in sent]
        ours = [told for told in timed if self._has(told[0]) and self._is_new(*told, now)]
        if not self._interval:
            self._waiting += ours
            return self.flush()
        since = [time - self._waiting[0][0] for time, _ in ours] if self._waiting else [0.0]
        if min(since, default=0.0) <= -self._interval:
            self.counts['time went back'] += 1
        is_over = max(np.abs(since), default=0.0) >= self._interval
        told = self.flush() if is_over else self.overdue(now)  # a sender's clock may stand still
        self._since = self._since if self._waiting else now
        self._waiting += ours
        return told

    def overdue(self, now: float) -> Told | None:
        """Return what waits as a message if it has waited for the interval; `now` as in `take`."""
        return self.flush() if now - self._since >= self._interval else None

    def flush(self) -> Told | None:
        """Return what waits for its interval to end as a message, None if nothing waits."""
        if not self._waiting:
            return None
        newest = _newest(self._waiting)
        if len(newest) < len(self._waiting):
            self.counts['told again within a message'] += len(self._waiting) - len(newest)
        stamp = self._stamp(min(time for time, _ in newest))
        plots = [(time, r) for time, r in newest if np.isfinite(r.range)]
        self._waiting = []
        self.counts['plots'] += len(plots)
        self.told += 1
        return stamp, from_columns(self._columns(plots, stamp), stamp, self._frame, self._types)

    def messages(self, chunks: Iterable[bytes]) -> Iterator[Told]:
        """Yield time [s] and message of everything that has reports."""
        for chunk in chunks:
            told = self.take(chunk)
            if told is not None:
                yield told
        last = self.flush()
        if last is not None:
            yield last

    def _time(self, report: Report, now: float) -> float:
        now = report.sent if np.isnan(now) else now
        if np.isfinite(report.time_of_day):
            return self.clock.time(report.time_of_day)
        ago = (now - report.second + 0.5 * MINUTE) % MINUTE - 0.5 * MINUTE
        if abs(ago) > _CREDIBLE:
            self.counts['second unlike the time of arrival'] += 1
        return now - ago if abs(ago) <= _CREDIBLE else now

    def _is_ours(self, report: Report) -> bool:
        self.source = report.source if self.source is None else self.source
        if report.source != self.source:
            self.counts['from another source'] += 1
        return report.source == self.source

    def _has(self, time: float) -> bool:
        if not np.isfinite(time):
            self.counts['without a time'] += 1
        return bool(np.isfinite(time))

    def _is_new(self, time: float, report: Report, now: float) -> bool:
        """Return whether this is no copy: receivers and networks are often doubled."""
        told = (round(time, 3), repr(report))
        if told in self._heard and not now - self._heard[told] > _COPY:
            self.counts['told twice'] += 1
            return False
        self._heard[told] = now
        if len(self._heard) > _REPORTS:
            del self._heard[next(iter(self._heard))]
        return True

    def _stamp(self, first: float) -> float:
        """Return a stamp for a message, no other one's, by the time of its first report [s]."""
        moment = round(first, 3)
        same = self._begun.count(moment)
        self._begun.append(moment)
        return first - AHEAD + same * APART

    def _columns(self, plots: Sequence[tuple[float, Report]], stamp: float) -> dict[str, Any]:
        def column(name: str) -> Any:
            return np.array([getattr(report, name) for _, report in plots], np.float32)

        amplitude, doppler = column('amplitude'), column('doppler')
        return {
            'range': column('range'),
            'azimuth': column('azimuth'),
            'time': np.array([time - stamp for time, _ in plots], np.float32),
            **({'amplitude': amplitude} if np.isfinite(amplitude).any() else {}),
            **({'range_rate': doppler} if self._with_doppler else {}),
            **({name: column(name) for name in HEIGHT} if self._with_height else {}),
            'id': np.array([report.track or 0 for _, report in plots], np.uint32),
        }


def _newest(reports: Sequence[tuple[float, Report]]) -> list[tuple[float, Report]]:
    """Return the last report of each numbered target: twice in a scan it would be two contacts."""
    last = {
        -1 - place if report.track is None else report.track: (time, report)
        for place, (time, report) in enumerate(reports)
    }
    return list(last.values())


def describe(feed: Feed) -> str:
    """Return what became of the reports, in words."""
    source = '/'.join(map(str, feed.source)) if isinstance(feed.source, tuple) else feed.source
    counts = ', '.join(f'{name} {count}' for name, count in sorted(feed.counts.items()))
    return f'{source or "no reports"}: {counts or "no data came"}'
