# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots could belong to which tracks? Found by a sweep, over a grid of cells if many."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
import math

import numpy as np

from tracking_core.batches import Floats, Ints
from tracking_core.linalg import wrap_angle

_FEW = 3_000  # track-plot combinations that are all compared sooner than sorted
_MANY = 500_000  # ... for which the cells are worth their price
MOST_PAIRS = 5_000_000  # that are looked at
_AT_ONCE = 2**14  # candidates whose arrays stay near the processor
_SAMPLED = 64  # boxes that tell the usual size
_MOST_CELLS, _CELLS_PER_PLOT = 2**16, 8  # of the grid: what 16 bits number, and not too many


def box_pairs(
    centre: Floats, half_size: Floats, plots: Floats, most: int = MOST_PAIRS
) -> tuple[Ints, Ints]:
    """
    Find all plots inside axis-parallel boxes around the tracks.

    Some hundreds of plots are sorted by their first coordinate. If there are more, they are sorted
    into the cells of a grid; a track looks only into those that its box touches, so that the work
    grows with the number of pairs, not with T times M.

    Parameters
    ----------
    centre : (T, d) array
        Middle of the box of each track.
    half_size : (T, d) array
        Half size of the boxes.
    plots : (M, d) array
        Positions of the plots; of the first two coordinates none is NaN.
    most : int
        Bound on the pairs looked at; boxes of later tracks beyond it stay empty.

    Returns
    -------
    track, plot : (P,) arrays
        Sorted by track, then plot.

    """
    empty = np.zeros(0, np.int64)
    if len(centre) == 0 or len(plots) == 0:
        return empty, empty
    combinations = len(centre) * len(plots)
    if combinations <= min(_FEW, most):
        return _compare_all(centre, half_size, plots)
    swept = combinations <= _MANY or plots.shape[1] == 1
    runs = (_sweep if swept else _touched)(centre, half_size, plots)
    # What a plot does not measure, NaN, keeps nobody out. A sweep has dealt with the first axis,
    # cells have with most of the first two.
    d = plots.shape[1]
    axes = range(1, d) if swept else (*range(2, d), 0, 1)
    found = [_inside(centre, half_size, plots, part, axes) for part in runs.parts(most)]
    track, plot = found[0] if len(found) == 1 else map(np.concatenate, zip(*found, strict=True))
    return _in_order(track, plot, len(plots))


@dataclass(frozen=True)
class _Runs:
    """Tracks with the plots that are perhaps in their boxes: runs of the plots in some order."""

    track: Ints  # (R,) ascending
    first: Ints  # (R,) places in the order
    count: Ints  # (R,)
    order: Ints  # (M,) plots

    def parts(self, most: int) -> Iterator[tuple[Ints, Ints]]:
        """Yield tracks (C,) with plots (C,), not too many at once and `most` in all."""
        ends, count = self.count.cumsum(), self.count
        total = ends[-1] if len(ends) else 0
        if total > most:
            count = np.where(ends > most, 0, count)
        cuts = ends.searchsorted(np.arange(_AT_ONCE, min(total, most), _AT_ONCE), 'right')
        for part in map(slice, (0, *cuts), (*cuts, len(ends))):
            place = _numbers(self.first[part], count[part])
            yield self.track[part].repeat(count[part]), self.order[place]


def _inside(
    centre: Floats, half_size: Floats, plots: Floats, pairs: tuple[Ints, Ints], axes: Iterable[int]
) -> tuple[Ints, Ints]:
    """Return those of the pairs whose plot is in the box on all these axes."""
    track, plot = pairs
    for axis in axes:
        apart = np.abs(plots[:, axis].take(plot) - centre[:, axis].take(track))
        inside = (~(apart > half_size[:, axis].take(track))).nonzero()[0]
        track, plot = track.take(inside), plot.take(inside)
    return track, plot


def _compare_all(centre: Floats, half_size: Floats, plots: Floats) -> tuple[Ints, Ints]:
    """Do what `box_pairs` does where there are few."""
    inside = np.abs(plots[:, 0] - centre[:, :1]) <= half_size[:, :1]
    for axis in range(1, plots.shape[1]):
        at = slice(axis, axis + 1)
        inside &= ~(np.abs(plots[:, axis] - centre[:, at]) > half_size[:, at])  # NaN: as above
    track, plot = inside.nonzero()
    return track, plot


def _sweep(centre: Floats, half_size: Floats, plots: Floats) -> _Runs:
    """Return the plots that are near enough in the first coordinate."""
    x, middle, half = plots[:, 0], centre[:, 0], half_size[:, 0]
    order = x.argsort(kind='stable')
    along = x[order]
    first = along.searchsorted(middle - half, 'left')
    count = np.maximum(along.searchsorted(middle + half, 'right') - first, 0)
    return _Runs(np.arange(len(centre)), first, count, order)


def sector_pairs(
    centre: Floats, half_size: Floats, plots: Floats, most: int = MOST_PAIRS
) -> tuple[Ints, Ints]:
    """Do the same for angles (T, 1) and (M, 1), which come again every turn [rad]."""
    M = len(plots)
    if len(centre) == 0 or M == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    angle, half = wrap_angle(plots[:, 0]), np.minimum(half_size[:, 0], np.pi * (1.0 - 1e-12))
    order = angle.argsort(kind='stable')[: np.count_nonzero(np.isfinite(angle))]  # NaN is last
    turn = np.array([-2.0, 0.0, 2.0])[:, None] * np.pi
    around, middle = (angle[order] + turn).reshape(-1), wrap_angle(centre[:, 0])
    first = around.searchsorted(middle - half, 'left')
    count = around.searchsorted(middle + half, 'right') - first
    count[count.cumsum() > most] = 0
    track = np.arange(len(centre)).repeat(count)
    place = _numbers(first, count)
    return _in_order(track, order[place % max(len(order), 1)], M)


def _touched(centre: Floats, half_size: Floats, plots: Floats) -> _Runs:
    """Return the plots in the cells that the boxes touch."""
    places, middle, half = plots.T[:2], centre.T[:2], half_size.T[:2]
    edge = places.min(axis=1, keepdims=True)
    extent = places.max(axis=1, keepdims=True) - edge
    size, shape = _cells(extent, half, len(plots))
    (columns, rows), last = shape[:, 0], shape - 1
    column, row = np.minimum(((places - edge) / size).astype(np.int64), last)
    cell = (row * columns + column).astype(np.uint16)  # short: sorted by counting
    order = cell.argsort(kind='stable')
    start = np.zeros(columns * rows + 1, np.int64)
    np.bincount(cell, minlength=columns * rows).cumsum(out=start[1:])

    middle = middle - edge
    left, bottom = _bound(np.floor((middle - half) / size), 0, shape).astype(np.int64)
    right, top = _bound(np.floor((middle + half) / size), -1, last).astype(np.int64)
    touched = np.maximum(top - bottom + 1, 0)
    owner = np.arange(len(centre)).repeat(touched)
    base = _numbers(bottom, touched) * columns
    first = start[base + left.take(owner)]
    count = np.maximum(start[base + right.take(owner) + 1] - first, 0)
    return _Runs(owner, first, count, order)


def _cells(extent: Floats, half_size: Floats, plots: int) -> tuple[Floats, Ints]:
    """Return width and height of the cells (2, 1), and how many there are each way (2, 1)."""
    usual = np.sort(half_size[:, :: max(half_size.shape[1] // _SAMPLED, 1)], axis=1)
    usual = np.maximum(usual[:, usual.shape[1] // 2, None], 1e-9)
    wide, high = np.minimum(extent / usual, _MOST_CELLS)[:, 0] + 1.0
    surplus = math.sqrt(wide * high / min(_MOST_CELLS, _CELLS_PER_PLOT * plots))
    columns, rows = (max(int(number / max(surplus, 1.0)), 1) for number in (wide, high))
    shape = np.array([[min(columns, _MOST_CELLS // rows)], [min(rows, _MOST_CELLS // columns)]])
    return np.maximum(extent / shape, 1e-9) * (1.0 + 1e-9), shape


def _in_order(track: Ints, plot: Ints, plots: int) -> tuple[Ints, Ints]:
    """Sort pairs, whose tracks are in order, by plot, too."""
    first = track * plots
    both = first + plot
    both.sort()
    return track, both - first


def _numbers(first: Ints, count: Ints) -> Ints:
    """Return first, first + 1, ... for each, `count` numbers of it, all in a row."""
    ends = count.cumsum()
    return np.asarray((first - ends + count).repeat(count) + np.arange(count.sum()))


def _bound(values: Floats, least: int, most: Ints) -> Floats:
    return np.asarray(np.minimum(np.maximum(values, least), most))
