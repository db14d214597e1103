# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a scan cost? CPU milliseconds by number of tracks, step by step, and how they grow.

Run ``python -m benchmarks.scan_cost [--sizes N ...] [--runs N]``. A scan is one antenna turn from
the message to the message: read the plots, track, write the tracks. Median over the scans after
warming up, and over the runs. Rows are named by contacts; the tracks, tentative ones included, are
more. The limits are for tracks, straight between the rows. Machines differ: judge by the ratios at
the end of each table. A sonar cycle comes last.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass
from functools import partial
from itertools import pairwise
from time import process_time
from typing import Any
from unittest.mock import patch

import numpy as np

from benchmarks import sonar_cost
from benchmarks.dense_traffic import messages, Traffic
from benchmarks.stopwatches import stopwatches
from msg_adapters.message_types import rosbags_types
from msg_adapters.plots import from_plots, to_plots
from msg_adapters.tracks import from_tracks
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.association import ASSOCIATORS
from tracking_core.association.jpda import jpda, LARGEST
from tracking_core.config import with_values

SIZES = (10, 50, 100, 200, 1000, 10_000)
WARM_UP, MEASURED = 24, 36  # turns, the denser clutter comes a little before
LIMITS = {200: 5.0, 1000: 20.0, 10_000: 200.0}  # [ms]
STEPS = {
    'antenna': ('radar_tracker.antenna', 'Antenna.follow'),
    'measure': ('radar_tracker.sensor', 'Radar.measure'),
    'predict': ('tracking_core.update', 'predict_tracks'),
    'gate': ('tracking_core.update', 'pair'),
    'associate': ('tracking_core.update', 'share_plots'),
    'update': ('tracking_core.update', '_update'),
    'start': ('tracking_core.tracker', 'start_tracks'),
    'merge': ('tracking_core.tracker', 'end_doubles'),
}


@dataclass(frozen=True)
class Cost:
    """Medians over the measured scans."""

    tracks: float
    confirmed: float
    plots: float
    total: float  # CPU of a scan [ms]
    steps: dict[str, float]  # [ms]
    bytes_per_track: float
    approximate: float  # share of tracks whose marginals are from belief propagation


def cost(traffic: Traffic, turns: int = WARM_UP + MEASURED) -> Cost:
    """Track the traffic and return what the scans after warming up cost."""
    config = with_values(RadarTrackerConfig(), traffic.parameters())
    types = rosbags_types()
    tracker, samples = RadarTracker(config), []
    for turn, plots in enumerate(messages(traffic, turns)):
        if turn == traffic.calm:
            tracker.reconfigure(with_values(config, traffic.parameters(turn)))
        message, previous = from_plots(plots, types), tracker.tracks
        with stopwatches(STEPS) as spent:
            begin = process_time()
            read = to_plots(message, config.sensor, 10_000_000).plots
            middle = process_time()
            tracks = tracker.track(read)
            after = process_time()
            from_tracks(previous, tracks, message.header, types, output=config.output,
                        gate_probability=config.gate.probability)  # fmt: skip
            end = process_time()
        spent = {'read': middle - begin, **spent, 'write': end - after}
        spent['rest'] = end - begin - sum(spent.values())
        if turn >= WARM_UP:
            report = tracker.state.report
            samples.append([len(tracks), tracks.confirmed.sum(), len(plots), end - begin,
                            report.approximate, *spent.values()])  # fmt: skip
    medians = np.median(samples, axis=0)
    steps = dict(zip(spent, 1e3 * medians[5:], strict=True))
    return Cost(
        tracks=medians[0], confirmed=medians[1], plots=medians[2], total=1e3 * medians[3],
        steps=steps, bytes_per_track=_size(tracker.tracks) / max(len(tracker.tracks), 1),
        approximate=min(medians[4] / max(medians[0], 1.0), 1.0),
    )  # fmt: skip


def _size(batch: Any) -> int:
    """Return the bytes of all arrays in a batch."""
    if isinstance(batch, np.ndarray):
        return batch.nbytes
    if isinstance(batch, tuple):
        return sum(_size(part) for part in batch)
    if is_dataclass(batch):
        return sum(_size(getattr(batch, f.name)) for f in fields(batch))
    return 0


def with_jpda(traffic: Traffic, largest: int = LARGEST) -> Cost:
    """Return the cost of JPDA with belief propagation in clusters of more tracks than this."""
    usual = RadarTrackerConfig().association
    with patch.dict(ASSOCIATORS, {usual: partial(jpda, largest=largest)}):
        return cost(traffic)


def _line(name: str, c: Cost) -> str:
    steps = ''.join(f'{value:10.2f}' for value in c.steps.values())
    return (
        f'{name:22}{c.tracks:8.0f}{c.confirmed:10.0f}{c.plots:8.0f}{c.total:9.2f}{steps}'
        f'{c.bytes_per_track:8.0f}{100 * c.approximate:7.1f}'
    )


def _head(steps: dict[str, float]) -> str:
    names = ''.join(f'{name:>10}' for name in steps)
    return f'{"CPU ms a scan":22}{"tracks":>8}{"confirmed":>10}{"plots":>8}{"total":>9}{names}' + (
        f'{"bytes":>8}{"prop%":>7}'
    )


def _judge(name: str, value: float, limit: float) -> str:
    return f'{name:52}{value:8.2f}{limit:8.2f}  {"good" if value <= limit else "ABOVE THE LIMIT"}'


def _ratios(
    plain: dict[int, Cost], denser: dict[float, Cost], exact: Cost, rough: Cost
) -> Iterator[str]:
    """Yield the measures that have a limit, each with it."""
    rows = sorted(plain.values(), key=lambda c: c.tracks)
    tracks, total = [c.tracks for c in rows], [c.total for c in rows]
    for size, limit in LIMITS.items():
        if tracks[0] <= size <= tracks[-1]:
            yield _judge(f'ms at {size} tracks', float(np.interp(size, tracks, total)), limit)
    for few, many in pairwise(c for c in rows if c.tracks >= 100):
        per_decade = (many.total / few.total) ** (1.0 / np.log10(many.tracks / few.tracks))
        name = f'growth per decade, {few.tracks:.0f} to {many.tracks:.0f} tracks'
        yield _judge(name, per_decade, 11.0)
    base, at = denser[1.0].total, denser[1.0].confirmed
    yield _judge(f'clutter x 4 / x 1, {at:.0f} tracks', denser[4.0].total / base, 1.6)
    yield _judge(f'clutter x 16 / x 4, {at:.0f} tracks', denser[16.0].total / denser[4.0].total,
                 np.inf)  # fmt: skip
    yield _judge(f'exact / propagation, {at:.0f} tracks', exact.total / rough.total, 1.5)
    yield _judge('bytes per track', max(c.bytes_per_track for c in plain.values()), 1000.0)


def middle_one(traffic: Traffic, runs: int) -> Cost:
    """Return the cost of the run that is in the middle of so many."""
    return sorted((cost(traffic) for _ in range(runs)), key=lambda c: c.total)[runs // 2]


def study(dimensions: int, sizes: Sequence[int], middle: int, runs: int = 1) -> None:
    """Print the table and the ratios of one kind of radar."""
    print(f'\n{dimensions}-D radar, {"two planes" if dimensions > 2 else "one plane"}')
    plain: dict[int, Cost] = {}
    for size in sizes:
        plain[size] = middle_one(Traffic(size, dimensions), runs)
        if size == sizes[0]:
            print(_head(plain[size].steps))
        print(_line(str(size), plain[size]), flush=True)
    denser = {
        x: middle_one(Traffic(middle, dimensions, clutter=x), runs) for x in (1.0, 4.0, 16.0)
    }
    for factor, c in denser.items():
        print(_line(f'{middle}, clutter x {factor:.0f}', c))
    exact, rough = (with_jpda(Traffic(middle, dimensions), most) for most in (LARGEST, 0))
    print(_line(f'{middle}, JPDA', exact))
    print(_line(f'{middle}, JPDA propagated', rough))
    print(f'{"ratio":52}{"value":>8}{"limit":>8}')
    for text in _ratios(plain, denser, exact, rough):
        print(text)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print both studies, and what a sonar cycle costs."""
    parser = argparse.ArgumentParser(description='CPU per scan by number of tracks.')
    parser.add_argument('--sizes', type=int, nargs='*', default=SIZES)
    parser.add_argument('--middle', type=int, default=1000, help='contacts for the comparisons')
    parser.add_argument('--runs', type=int, default=1, help='the middle one of so many counts')
    given = parser.parse_args(arguments)
    for dimensions in (3, 2):
        study(dimensions, given.sizes, given.middle, given.runs)
    print()
    for line in sonar_cost.lines():
        print(line)


if __name__ == '__main__':
    main()
