# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which rows of a message can be right, and why the others cannot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from tracking_core.batches import Bearings, Bools, Floats, Plots

MAX_OFFSET = 60.0  # s between a plot and the stamp of its message; no antenna turns slower
# What optional values may be; outside, the row is used as if it did not tell.
LIMITS = {
    'range_sd': (1e-3, 1e5),  # m
    'azimuth_sd': (1e-6, 0.5),  # rad
    'elevation_sd': (1e-6, 0.5),  # rad
    'range_rate_sd': (1e-3, 1e3),  # m/s
    'bearing_sd': (1e-6, 0.5),  # rad
    'range_rate': (-1e4, 1e4),  # m/s
    'snr': (-1e3, 1e3),  # dB
    'amplitude': (-1e3, 1e3),  # dB
}
WITHOUT_REFERENCE = ('amplitude',)  # nobody can say which of its values are wrong
WIDEST = 2.51 * np.pi  # a quarter turn more than one: compass angles have been turned already
OUT_OF_RANGE = ('range below', 'range beyond')  # reasons that no fault is behind
NO_NUMBER = 'is not a number'  # so a reason ends, which may be none: see `is_dense`
Check = tuple[str, Bools]  # a reason, and the rows (M,) that it holds for


def usable_values(read: Mapping[str, Floats]) -> tuple[dict[str, Floats], dict[str, int]]:
    """
    Return the optional columns without values outside `LIMITS`, and a count of those.

    NaN says that the sensor does not know, and is not counted.
    """
    usable, doubtful = {}, {}
    for name, (low, high) in LIMITS.items():
        if name not in read:
            continue
        inside = (read[name] >= low) & (read[name] <= high)
        usable[name] = np.where(inside, read[name], np.nan)
        wrong = int(np.sum(~inside & ~np.isnan(read[name])))
        if wrong and name not in WITHOUT_REFERENCE:
            doubtful[f'{name} outside [{low:g}, {high:g}]'] = wrong
    return usable, doubtful


def choose_rows(
    rows: Plots | Bearings, checks: Iterable[Check], longest: float = np.inf
) -> tuple[Bools, dict[str, int]]:
    """
    Return which rows to use (M,), and how many were dropped for each reason.

    A row is counted once, for the first reason that holds; times are checked last: no plot is
    more than `longest` [s] off the stamp of its message, nor more than `MAX_OFFSET`.
    """
    keep = np.ones(len(rows), bool)
    dropped = {}
    with np.errstate(invalid='ignore', over='ignore'):
        for reason, wrong in (*checks, *_time_checks(rows, min(longest, MAX_OFFSET))):
            count = int(np.count_nonzero(wrong & keep))
            if count:
                dropped[reason] = count
                keep &= ~wrong
    return keep, dropped


def _time_checks(rows: Plots | Bearings, longest: float) -> Iterator[Check]:
    yield f'time {NO_NUMBER}', ~np.isfinite(rows.time)
    late = np.abs(rows.time - rows.stamp) > longest
    yield f'time more than {longest:.3g} s off the stamp', late


def bearing_checks(bearing: Floats) -> Iterator[Check]:
    """Yield what can be wrong with the bearings (M,) of a sonar."""
    yield f'bearing {NO_NUMBER}', ~np.isfinite(bearing)
    yield 'bearing beyond 2 pi', np.abs(bearing) > WIDEST


def plot_checks(plots: Plots, polar: bool, range_min: float, range_max: float) -> Iterator[Check]:
    """Yield what can be wrong with plots of a radar."""
    yield from _polar_checks(plots) if polar else _position_checks(plots)
    distance = plots.range if polar else np.hypot(plots.position[:, 0], plots.position[:, 1])
    yield f'range below range_min = {range_min:g}', distance < range_min
    yield f'range beyond range_max = {range_max:g}', distance > range_max


def _polar_checks(plots: Plots) -> Iterator[Check]:
    yield f'range {NO_NUMBER}', ~np.isfinite(plots.range)
    yield 'range is negative', plots.range < 0.0
    yield f'azimuth {NO_NUMBER}', ~np.isfinite(plots.azimuth)
    yield 'azimuth beyond 2 pi', np.abs(plots.azimuth) > WIDEST
    yield 'elevation beyond pi / 2 (degrees?)', np.abs(plots.elevation) > 0.51 * np.pi


def _position_checks(plots: Plots) -> Iterator[Check]:
    for axis, name in enumerate('xy'):
        yield f'{name} {NO_NUMBER}', ~np.isfinite(plots.position[:, axis])
    yield f'z {NO_NUMBER}', _partly_missing(plots.position[:, 2])


def _partly_missing(values: Floats) -> Bools:
    """Return which are no numbers; if all are NaN, the sensor does not measure this at all."""
    return ~np.isfinite(values) & ~np.isnan(values).all()
