# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots could belong to which tracks? Found over a grid of rows, sorted within each row."""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints


def box_pairs(
    centre: Floats, half_size: Floats, plots: Floats, most: int = 5_000_000
) -> tuple[Ints, Ints]:
    """
    Find all plots inside axis-parallel boxes around the tracks.

    Plots are sorted by grid row, then by x; a track looks only into the rows that its box
    touches, so that the work grows with the number of pairs, not with T times M.

    Parameters
    ----------
    centre : (T, d) array
        Middle of the box of each track; only the first two coordinates are looked at.
    half_size : (T, d) array
        Half size of the boxes.
    plots : (M, d) array
        Positions of the plots.
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
    if plots.shape[1] == 1:  # one coordinate: one row
        centre, half_size = np.pad(centre, ((0, 0), (0, 1))), np.pad(half_size, ((0, 0), (0, 1)))
        plots = np.pad(plots, ((0, 0), (0, 1)))
    key, order, (owner, from_key, to_key) = _rows(centre, half_size, plots)
    first = np.searchsorted(key, from_key, 'left')
    count = np.maximum(np.searchsorted(key, to_key, 'right') - first, 0)
    count[np.cumsum(count) > most] = 0
    track = np.repeat(owner, count)
    plot = order[np.repeat(first - np.cumsum(count) + count, count) + np.arange(count.sum())]
    inside = (np.abs(plots[plot, :2] - centre[track, :2]) <= half_size[track, :2]).all(axis=1)
    track, plot = track[inside], plot[inside]
    by_track = np.lexsort((plot, track))
    return track[by_track], plot[by_track]


def _rows(
    centre: Floats, half_size: Floats, plots: Floats
) -> tuple[Floats, Ints, tuple[Ints, Floats, Floats]]:
    """Return plots as sorted keys (row number times width, plus x), and what tracks look for."""
    left, bottom = plots[:, 0].min(), plots[:, 1].min()
    width = 2.0 * (plots[:, 0].max() - left) + 1.0
    height = max(2.0 * float(np.median(half_size[:, 1])), 1e-9)
    rows = int(min((plots[:, 1].max() - bottom) / height, 10_000.0)) + 1
    height = max((plots[:, 1].max() - bottom) / rows, 1e-9) * (1.0 + 1e-9)
    row = np.minimum(((plots[:, 1] - bottom) / height).astype(np.int64), rows - 1)
    key = row * width + (plots[:, 0] - left)
    order = np.argsort(key, kind='stable')

    low, high = centre - half_size, centre + half_size
    first_row = np.clip(np.floor((low[:, 1] - bottom) / height), 0, rows).astype(np.int64)
    last_row = np.clip(np.floor((high[:, 1] - bottom) / height), -1, rows - 1).astype(np.int64)
    touched = np.maximum(last_row - first_row + 1, 0)
    owner = np.repeat(np.arange(len(centre)), touched)
    into = np.arange(touched.sum()) - np.repeat(np.cumsum(touched) - touched, touched)
    base = (first_row[owner] + into) * width
    from_x = np.clip(low[owner, 0] - left, 0.0, width / 2.0)
    to_x = np.clip(high[owner, 0] - left, -1.0, width / 2.0 - 0.5)
    return key[order], order, (owner, base + from_x, base + to_x)
