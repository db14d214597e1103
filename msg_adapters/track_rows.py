# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What every track table has, whatever the sensor: identity, times, looks, gate and modes."""

from __future__ import annotations

import numpy as np

from msg_adapters.table import Columns
from tracking_core.batches import Bools, Tracks
from tracking_core.chances import chi_square_bound
from tracking_core.rows import take

TENTATIVE, CONFIRMED, DELETED = 0, 1, 2  # of the column `status`


def gone(previous: Tracks, tracks: Tracks) -> Tracks:
    """Return those of the previous tracks that are gone."""
    return take(previous, ~np.isin(previous.id, tracks.id, assume_unique=True, kind='sort'))


def common_columns(rows: Tracks, deleted: Bools, stamp: float, gate_probability: float) -> Columns:
    """
    Return the columns that do not depend on the sensor.

    Parameters
    ----------
    rows : Tracks
        Those of the table, with the deleted ones.
    deleted : (T,) array
        Which are gone.
    stamp : float
        Of the table [s].
    gate_probability : float
        Chance of the true plot to fall into the gate, as the tracker has it.

    """
    status, size = np.where(rows.confirmed, CONFIRMED, TENTATIVE), rows.gate_size.shape[1]
    single = np.float32
    return {
        'id': rows.id.astype(np.uint32),
        'status': np.where(deleted, DELETED, status).astype(np.uint8),
        'coasted': (rows.coasted > 0).astype(np.uint8),
        'time': (rows.time - stamp).astype(single),
        'age': (rows.time - rows.birth_time).astype(single),
        'hits': rows.hits.astype(np.uint32),
        'misses': rows.coasted.astype(np.uint32),
        'existence_probability': rows.existence_probability.astype(single),
        'nis': rows.nis.astype(single),
        'gate_threshold': np.full(len(rows), chi_square_bound(gate_probability, size), single),
        'gate_volume': rows.gate_volume.astype(single),
        **_mode_columns(rows),
    }


def _mode_columns(tracks: Tracks) -> Columns:
    """Return how likely each mode is; the first mode of a plane is its quiet one."""
    columns: Columns = {}
    for plane, infix in zip(tracks.planes, ('', 'vertical_'), strict=False):
        probability = plane.mode_probability.astype(np.float32)
        suffix = f'_{infix[:-1]}' if infix else ''
        columns[f'manoeuvre_probability{suffix}'] = 1 - probability[:, 0]
        columns |= {f'p_{infix}{mode}': row for mode, row in enumerate(probability.T)}
    return columns
