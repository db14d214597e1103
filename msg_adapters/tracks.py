# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How radar tracks become the rows of one PointCloud2, and columns again.

`track_columns` names every column once; documentation and tools follow it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.message_types import MessageTypes, seconds
from msg_adapters.table import Columns, from_columns_under, to_columns
from msg_adapters.track_rows import common_columns, gone
from tracking_core.batches import Floats, Tracks

AXES = 3
# Where (x, vx, y, vy) and (z, vz), or both as one state, stand in (x, y, z, vx, vy, vz).
_PLACES = (np.array([0, 3, 1, 4]), np.array([2, 5]))
_JOINT = np.concatenate(_PLACES)


def from_tracks(
    previous: Tracks,
    tracks: Tracks,
    header: Any,
    types: MessageTypes,
    *,
    output: str,
    gate_probability: float,
) -> Any:
    """
    Return the track table as a PointCloud2.

    Parameters
    ----------
    previous : Tracks
        What was published before; its tracks that are gone get one last row as deleted.
    tracks : Tracks
        What there is now.
    header : Header
        Of the scan, in the tracking frame.
    types : MessageTypes
        Classes to build the message from.
    output : str
        'mmse' or 'map': which estimate of the mixture is shown.
    gate_probability : float
        Chance of the true plot to fall into the gate, as the tracker has it.

    """
    with np.errstate(over='ignore'):  # beyond float32 is infinite
        columns = track_columns(previous, tracks, seconds(header.stamp), output, gate_probability)
    return from_columns_under(header, columns, types)


def to_track_columns(msg: Any, max_rows: int = 1_000_000) -> Columns:
    """Return the columns of a track table by name; raises BadMessage as `to_columns`."""
    return to_columns(msg, max_rows)


def track_columns(
    previous: Tracks, tracks: Tracks, stamp: float, output: str, gate_probability: float
) -> Columns:
    """Return every column of the track table (T + D rows, the D deleted ones last)."""
    last = gone(previous, tracks)
    columns = _columns(tracks, False, stamp, output, gate_probability)
    if not len(last):
        return columns
    # They may be of a radar that was not yet found to tell heights.
    below = _columns(last, True, stamp, output, gate_probability)
    nothing = np.full(len(last), np.nan, np.float32)
    return {name: np.concatenate([v, below.get(name, nothing)]) for name, v in columns.items()}


def _columns(
    rows: Tracks, is_last: bool, stamp: float, output: str, gate_probability: float
) -> Columns:
    """Return every column of these tracks, which are gone or not."""
    state, covariance = kinematics(rows, output)
    gate = np.full((len(rows), AXES), np.nan)
    gate[:, : rows.gate_size.shape[1]] = rows.gate_size
    single = np.float32
    return {
        **dict(zip(('x', 'y', 'z', 'vx', 'vy', 'vz'), state.T.astype(single), strict=True)),
        **common_columns(rows, np.full(len(rows), is_last), stamp, gate_probability),
        'speed': np.hypot(state[:, 3], state[:, 4]).astype(single),
        'course': np.arctan2(state[:, 4], state[:, 3]).astype(single),
        **dict(zip(('gate_x', 'gate_y', 'gate_z'), gate.T.astype(single), strict=True)),
        'covariance': covariance.reshape(-1, 4 * AXES * AXES),
    }


def to_bodies(tracks: Tracks, output: str) -> Bodies:
    """Return where the tracks are and how they move."""
    return Bodies(tracks.id, tracks.time, *kinematics(tracks, output))


def kinematics(tracks: Tracks, output: str) -> tuple[Floats, Floats]:
    """
    Return the state as everybody expects it.

    Parameters
    ----------
    tracks : Tracks
        One or two planes, or one of all axes.
    output : str
        'mmse' or 'map'.

    Returns
    -------
    state : (T, 6) array
        x, y, z, vx, vy, vz; z and vz are 0 without a vertical plane.
    covariance : (T, 6, 6) array
        The same order; the variances of z and vz are NaN without a vertical plane.

    """
    state = np.zeros((len(tracks), 2 * AXES))
    covariance = np.zeros((len(tracks), 2 * AXES, 2 * AXES))
    covariance[:, _PLACES[1], _PLACES[1]] = np.nan
    for plane, part_places in zip(tracks.planes, _PLACES, strict=False):
        places = _JOINT if plane.mean.shape[2] == len(_JOINT) else part_places
        state[:, places], part = plane.estimate(output)
        covariance[:, places[:, None], places] = part
    return state, covariance
