# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which real marine radar recordings are there to track? See ``recordings`` for the form."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.recordings import Columns, columns_of, load, Recording, stretches_of
from tracking_core.batches import Floats, Ints, Plots
from tracking_core.platform import Platform
from tracking_tools.scoring import PlotRows, Stretches, Truth

_BOAT_RADIUS = 20.0  # match radius [m]


def autoferry(folder: Path, number: str) -> Recording:
    """
    Return a scene of two boats seen from a ferry under way; all of a scan at one time.

    The set does not say which plot is whose: the nearest to a boat within the match radius counts
    as its plot, also when it is the nearest to both, for close boats share one plot.
    """
    d = load(folder, f'marine_autoferry/autoferry_{number}')
    times, scan = d['radar_scan_t'], d['radar_scan']
    own = columns_of(d, 'radar_own_e', 'radar_own_n')
    offset = columns_of(d, 'radar_e', 'radar_n')
    truth = Truth.of(
        d['truth_target'].astype(np.int64), d['truth_t'], columns_of(d, 'truth_e', 'truth_n'),
        _slopes(d),
    )  # fmt: skip
    position = offset + own[scan]
    plots = _nearest(truth, times, scan, position)
    messages = tuple(
        replace(_relative(offset[scan == k], times[k]), stamp=float(times[k]))
        for k in range(len(times))
    )
    return Recording(
        f'autoferry_{number}', 'fast_small_craft_radar', messages, plots, truth,
        stretches_of(plots, messages), _BOAT_RADIUS, 2.0, _platform(times, own),
        has_velocity=False,
    )  # fmt: skip


def canal(folder: Path, name: str) -> Recording:
    """Return a harbour scene without truth; all of a scan at one time."""
    d = load(folder, f'marine_canal/canal_{name}')
    times, scan, position = d['scan_t'], d['scan'], columns_of(d, 'x', 'y')
    nobody = np.zeros(0, np.int64)
    messages = tuple(
        replace(_relative(position[scan == k], times[k]), stamp=float(times[k]))
        for k in range(len(times))
    )
    truth = Truth.of(nobody, np.zeros(0), np.zeros((0, 2)), np.zeros((0, 2)))
    return Recording(
        f'canal_{name[:10]}', 'harbour_radar', messages,
        PlotRows(times[scan], position, np.full(len(scan), -1)), truth,
        Stretches(nobody, nobody, nobody), _BOAT_RADIUS, 2.0,
    )  # fmt: skip


def _relative(offset: Floats, time: float) -> Plots:
    """Return polar plots of a radar in the origin of these offsets (M, 2)."""
    distance = np.hypot(offset[:, 0], offset[:, 1])
    return Plots.polar(
        np.full(len(offset), time), distance, np.arctan2(offset[:, 1], offset[:, 0])
    )


def _nearest(truth: Truth, times: Floats, scan: Ints, position: Floats) -> PlotRows:
    """Return of each scan and contact the nearest plot, if within the match radius."""
    rows, owners = [], []
    for contact in np.unique(truth.id):
        gap = np.linalg.norm(position - truth.of_contact(contact).at(times[scan]).position, axis=1)
        least = np.full(len(times), _BOAT_RADIUS)
        np.minimum.at(least, scan, gap)
        rows.append(np.flatnonzero(gap == least[scan]))
        owners.append(np.full(len(rows[-1]), contact))
    row = np.concatenate(rows)
    return PlotRows(times[scan[row]], position[row], np.concatenate(owners))


def _slopes(d: Columns) -> Floats:
    """Return velocities (K, 2) from the samples of each boat."""
    velocity = np.zeros((len(d['truth_t']), 2))
    for contact in np.unique(d['truth_target']):
        mine = d['truth_target'] == contact
        position = columns_of(d, 'truth_e', 'truth_n')[mine]
        velocity[mine] = np.gradient(position, d['truth_t'][mine], axis=0)
    return velocity


def _platform(times: Floats, own: Floats) -> Platform:
    """Return own ship from its positions (K, 2), axes to the east and north."""
    K = len(times)
    flat = np.concatenate([own, np.zeros((K, 1))], axis=1)
    return Platform(
        times, flat, np.tile([0.0, 0.0, 0.0, 1.0], (K, 1)), np.gradient(flat, times, axis=0),
        np.zeros((K, 3, 3)), np.zeros(K),
    )  # fmt: skip
