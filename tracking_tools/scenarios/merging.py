# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which plots fall into one resolution cell, and the single plot that comes out."""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from tracking_core.batches import Floats, Ints
from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios.radar import SimulatedRadar


def merge_unresolved(
    radar: SimulatedRadar, columns: dict[str, Floats], contact: Ints
) -> tuple[dict[str, Floats], Ints]:
    """
    Make one plot of those that the radar cannot tell apart.

    Parameters
    ----------
    radar : SimulatedRadar
        Its ``range_resolution`` and ``azimuth_resolution``; with 0 in either nothing merges.
    columns : dict of (M,) arrays
        Polar plots in order of time.
    contact : (M,) array
        Whose plot each one is.

    Returns
    -------
    columns, contact
        Means of the merged plots, with the identity of the strongest.

    """
    if not (radar.range_resolution > 0.0 and radar.azimuth_resolution > 0.0):
        return columns, contact
    pairs = _unresolved_pairs(radar, columns)
    count = len(contact)
    links = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count))
    cells, cell = connected_components(links, directed=False)
    strongest = np.lexsort((-columns['snr'], cell))
    strongest = strongest[np.unique(cell[strongest], return_index=True)[1]]  # (cells,)
    size = np.bincount(cell, minlength=cells)
    merged = {}
    for name, column in columns.items():
        reference = column[strongest][cell]
        off = wrap_angle(column - reference) if name == 'azimuth' else column - reference
        mean = column[strongest] + np.bincount(cell, weights=off, minlength=cells) / size
        merged[name] = wrap_angle(mean) if name == 'azimuth' else mean
    order = np.argsort(merged['time'], kind='stable')
    return {name: column[order] for name, column in merged.items()}, contact[strongest][order]


def _unresolved_pairs(radar: SimulatedRadar, columns: dict[str, Floats]) -> Ints:
    """Pairs (K, 2) closer than the resolution in range and azimuth, of one pass."""
    azimuth, time = columns['azimuth'], columns['time']
    cells = np.stack(
        [
            columns['range'] / radar.range_resolution,
            np.cos(azimuth) / radar.azimuth_resolution,
            np.sin(azimuth) / radar.azimuth_resolution,
            time / (0.25 * radar.period),
        ],
        axis=1,
    )
    # A candidate is off by at most 1 in range, 1 in azimuth (chord) and 2 in time.
    near: Ints = cKDTree(cells).query_pairs(math.sqrt(6.0), output_type='ndarray')
    one, other = near[:, 0], near[:, 1]
    close = (
        (np.abs(columns['range'][one] - columns['range'][other]) < radar.range_resolution)
        & (np.abs(wrap_angle(azimuth[one] - azimuth[other])) < radar.azimuth_resolution)
        & (np.abs(time[one] - time[other]) < 0.5 * radar.period)
    )
    return near[close]
