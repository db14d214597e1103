# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots could belong to which tracks? Found over a grid of rows, sorted within each row."""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints
from tracking_core.linalg import wrap_angle

_FEW = 20_000  # track-plot combinations that are all compared sooner than sorted


def box_pairs(
    centre: Floats, half_size: Floats, plots: Floats, most: int = 5_000_000
) -> tuple[Ints, Ints]:
    """
    Find all plots inside axis-parallel boxes around the tracks.

    Unless they are few, plots are sorted by grid row, then by x; a track looks only into the rows
    that its box touches, so that the work grows with the number of pairs, not with T times M.

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
    if len(centre) * len(plots) <= min(_FEW, most):
        return _compare_all(centre, half_size, plots)
    if plots.shape[1] == 1:  # one coordinate: one row
        centre, half_size = np.pad(centre, ((0, 0), (0, 1))), np.pad(half_size, ((0, 0), (0, 1)))
        plots = np.pad(plots, ((0, 0), (0, 1)))
    key, order, (owner, from_key, to_key) = _rows(centre, half_size, plots)
    first = key.searchsorted(from_key, 'left')
    count = np.maximum(key.searchsorted(to_key, 'right') - first, 0)
    count[count.cumsum() > most] = 0
    track = owner.repeat(count)
    plot = order[_runs(first, count)]
    for axis in range(plots.shape[1]):  # what a plot does not measure, NaN, keeps nobody out
        apart = np.abs(plots[plot, axis] - centre[track, axis])
        inside = ~(apart > half_size[track, axis])
        track, plot = track[inside], plot[inside]
    both = track * len(plots) + plot
    both.sort()
    return np.divmod(both, len(plots))


def _compare_all(centre: Floats, half_size: Floats, plots: Floats) -> tuple[Ints, Ints]:
    """Do what `box_pairs` does, without order."""
    inside = np.abs(plots[:, 0] - centre[:, :1]) <= half_size[:, :1]
    for axis in range(1, plots.shape[1]):
        at = slice(axis, axis + 1)
        inside &= ~(np.abs(plots[:, axis] - centre[:, at]) > half_size[:, at])  # NaN: as below
    track, plot = inside.nonzero()
    return track, plot


def sector_pairs(
    centre: Floats, half_size: Floats, plots: Floats, most: int = 5_000_000
) -> tuple[Ints, Ints]:
    """Do the same for angles (T, 1) and (M, 1), which come again every turn [rad]."""
    M = len(plots)
    if len(centre) == 0 or M == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    angle, half = wrap_angle(plots[:, 0]), np.minimum(half_size[:, 0], np.pi * (1.0 - 1e-12))
    order = np.argsort(angle, kind='stable')[: np.isfinite(angle).sum()]  # NaN comes last
    turn = np.array([-2.0, 0.0, 2.0])[:, None] * np.pi
    around, middle = (angle[order] + turn).reshape(-1), wrap_angle(centre[:, 0])
    first = np.searchsorted(around, middle - half, 'left')
    count = np.searchsorted(around, middle + half, 'right') - first
    count[np.cumsum(count) > most] = 0
    track = np.repeat(np.arange(len(centre)), count)
    place = _runs(first, count)
    return np.divmod(np.sort(track * M + order[place % max(len(order), 1)]), M)


def _rows(
    centre: Floats, half_size: Floats, plots: Floats
) -> tuple[Floats, Ints, tuple[Ints, Floats, Floats]]:
    """Return plots as sorted keys (row number times width, plus x), and what tracks look for."""
    x, y = plots[:, 0], plots[:, 1]
    left, bottom, top = x.min(), y.min(), y.max()
    width = 2.0 * (x.max() - left) + 1.0
    height = max(2.0 * float(np.sort(half_size[:, 1])[len(centre) // 2]), 1e-9)
    rows = int(min((top - bottom) / height, 10_000.0)) + 1
    height = max((top - bottom) / rows, 1e-9) * (1.0 + 1e-9)
    row = np.minimum(((y - bottom) / height).astype(np.int64), rows - 1)
    key = row * width + (x - left)
    order = key.argsort(kind='stable')

    low, high = centre - half_size, centre + half_size
    first_row = _bound(np.floor((low[:, 1] - bottom) / height), 0, rows).astype(np.int64)
    last_row = _bound(np.floor((high[:, 1] - bottom) / height), -1, rows - 1).astype(np.int64)
    touched = np.maximum(last_row - first_row + 1, 0)
    owner = np.arange(len(centre)).repeat(touched)
    base = _runs(first_row, touched) * width
    from_x = _bound(low[owner, 0] - left, 0.0, width / 2.0)
    to_x = _bound(high[owner, 0] - left, -1.0, width / 2.0)
    return key[order], order, (owner, base + from_x, base + to_x)


def _runs(first: Ints, count: Ints) -> Ints:
    """Return first, first + 1, ... for each, `count` numbers of it, all in a row."""
    ends = count.cumsum()
    return np.asarray((first - ends + count).repeat(count) + np.arange(count.sum()))


def _bound(values: Floats, least: float, most: float) -> Floats:
    return np.asarray(np.minimum(np.maximum(values, least), most))
