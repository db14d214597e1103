# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which columns of a track table are compared with the truth?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from msg_adapters.table import Columns
from msg_adapters.track_rows import CONFIRMED
from tracking_core.batches import Bools, Floats
from tracking_tools.scoring import TrackRows
from tracking_tools.track_table import COVARIANCE, NEEDED

PLACE = {'radar': ('x', 'y'), 'sonar': ('bearing',)}


def judged_rows(table: Columns, sensor: str) -> Bools:
    """Return which rows are compared: of confirmed tracks, with numbers where they are."""
    known = [np.isfinite(table[name]) for name in PLACE[sensor]]
    return np.asarray(np.all([table['status'] == CONFIRMED, *known], axis=0))


def no_rows(needed: Sequence[str]) -> Columns:
    """Return a track table without rows; nothing was tracked, which is a result, too."""
    columns: Columns = {name: np.zeros(0) for name in (*needed, 'stamp', 'time')}
    return columns | {'covariance': np.zeros((0, *COVARIANCE))}


def has_heights(table: Columns) -> bool:
    """Return whether the tracks of a radar are in three dimensions, all of them."""
    full = table['covariance'].reshape(-1, 6, 6)
    level = np.isfinite(full[:, 0, 0]) & ~np.isfinite(full[:, 2, 2])
    is_high = bool(np.isfinite(full[:, 2, 2]).any() and np.isfinite(table['z']).all())
    return is_high and not level.any()


def position_rows(table: Columns, stamps: Floats, d: int) -> TrackRows:
    """Return `d` coordinates of a radar's table; `stamps` (K,) are those of the scans [s]."""
    full = table['covariance'].reshape(-1, 6, 6)
    state = np.stack([table[n] for n in ('x', 'y', 'z', 'vx', 'vy', 'vz')], axis=1)
    state = state.astype(np.float64)
    at = np.concatenate([np.arange(d), 3 + np.arange(d)])
    return TrackRows(
        np.searchsorted(stamps, table['stamp']), table['id'].astype(np.int64), table['time'],
        state[:, :d], state[:, 3 : 3 + d], full[:, at[:, None], at],
    )  # fmt: skip


def bearing_rows(table: Columns, stamps: Floats) -> TrackRows:
    """Return the rows of a sonar's table; `stamps` (K,) are those of the scans [s]."""
    column = {n: table[n].astype(np.float64)[:, None] for n in NEEDED['sonar'][2:]}
    variance = np.concatenate([column['bearing_sd'], column['bearing_rate_sd']], axis=1) ** 2
    covariance = variance[:, :, None] * np.eye(2)  # the table does not tell the correlation
    return TrackRows(
        np.searchsorted(stamps, table['stamp']), table['id'].astype(np.int64), table['time'],
        column['bearing'], column['bearing_rate'], covariance, angular=True,
    )  # fmt: skip
