# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How sonar tracks become the rows of one PointCloud2.

`bearing_track_columns` names every column once; documentation and tools follow it.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.message_types import MessageTypes, seconds
from msg_adapters.table import Columns, from_columns_under
from msg_adapters.track_rows import common_columns, gone
from tracking_core.batches import Bools, Floats, Tracks
from tracking_core.rows import concatenate

_PLACES = np.array([0, 1, 3, 4])  # where (x, y, vx, vy) stand in (x, y, z, vx, vy, vz)
_HEIGHTS = np.array([2, 5])  # z and vz


class BearingStates(Protocol):
    """Directions of T tracks, an array (T,) each."""

    @property
    def bearing(self) -> Floats:
        """Return the bearing in tracking axes [rad]."""

    @property
    def bearing_rate(self) -> Floats:
        """Return how fast it turns [rad/s]."""

    @property
    def bearing_sd(self) -> Floats:
        """Return its sd [rad]."""

    @property
    def bearing_rate_sd(self) -> Floats:
        """Return the sd of the rate [rad/s]."""


class Ranges(Protocol):
    """Where T tracks are, an array (T,) each if not said; NaN where that cannot be known."""

    @property
    def observable(self) -> Bools:
        """Return whether the range can be known."""

    @property
    def range(self) -> Floats:
        """Return the range from the sensor [m]."""

    @property
    def range_sd(self) -> Floats:
        """Return its sd [m]."""

    @property
    def speed(self) -> Floats:
        """Return the speed over ground [m/s]."""

    @property
    def course(self) -> Floats:
        """Return the course over ground, anticlockwise from x [rad]."""

    @property
    def state(self) -> Floats:
        """Return x, y, vx, vy (T, 4)."""

    @property
    def covariance(self) -> Floats:
        """Return the covariance (T, 4, 4) of the state."""


class Directions(Protocol):
    """How the directions of any tracks are told."""

    def __call__(self, tracks: Tracks, output: str, /) -> BearingStates:
        """Return bearings and rates of the tracks."""


def from_bearing_tracks(
    previous: Tracks,
    tracks: Tracks,
    ranges: Ranges,
    header: Any,
    types: MessageTypes,
    *,
    directions: Directions,
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
    ranges : Ranges
        Of these tracks, row by row.
    header : Header
        Of the cycle, in the tracking frame.
    types : MessageTypes
        Classes to build the message from.
    directions : callable
        Returns bearings and rates of tracks.
    output : str
        'mmse' or 'map': which estimate of the mixture is shown.
    gate_probability : float
        Chance of the true mark to fall into the gate, as the tracker has it.

    """
    last = gone(previous, tracks)
    rows = concatenate(tracks, last) if len(last) else tracks
    deleted = np.arange(len(rows)) >= len(tracks)
    common = common_columns(rows, deleted, seconds(header.stamp), gate_probability)
    columns = bearing_track_columns(directions(rows, output), ranges, rows.gate_size[:, 0])
    return from_columns_under(header, {**columns, **common}, types)


def bearing_track_columns(states: BearingStates, ranges: Ranges, gate: Floats) -> Columns:
    """
    Return the columns that sonar tracks have beside the common ones.

    Parameters
    ----------
    states : BearingStates
        Of all rows (T + D).
    ranges : Ranges
        Of the first rows (T); the D deleted ones have none.
    gate : (T + D,) array
        Half sizes of the gates [rad].

    """
    rows, single = len(gate), np.float32
    observable = np.zeros(rows, bool)
    observable[: len(ranges.observable)] = ranges.observable
    line = np.stack([np.cos(states.bearing), np.sin(states.bearing)], axis=1)
    place = np.where(observable[:, None], _padded(ranges.state[:, :2], rows), line)
    return {
        'x': place[:, 0].astype(single),
        'y': place[:, 1].astype(single),
        'z': np.zeros(rows, single),
        'bearing': states.bearing.astype(single),
        'bearing_rate': states.bearing_rate.astype(single),
        'bearing_sd': states.bearing_sd.astype(single),
        'bearing_rate_sd': states.bearing_rate_sd.astype(single),
        'gate': gate.astype(single),
        'range': _padded(ranges.range, rows).astype(single),
        'range_sd': _padded(ranges.range_sd, rows).astype(single),
        'speed': _padded(ranges.speed, rows).astype(single),
        'course': _padded(ranges.course, rows).astype(single),
        'observable': observable.astype(np.uint8),
        'covariance': _padded(ranges.covariance, rows).reshape(rows, 16),
    }


def _padded(values: Floats, rows: int) -> Floats:
    """Return the values with rows of NaN below."""
    padded = np.full((rows, *values.shape[1:]), np.nan)
    padded[: len(values)] = values
    return padded


def located_bodies(tracks: Tracks, ranges: Ranges, wanted: Bools) -> Bodies:
    """Return position and velocity of the tracks (T,) that are wanted and observable."""
    rows = np.flatnonzero(ranges.observable & wanted)
    state = np.zeros((len(rows), 6))
    covariance = np.zeros((len(rows), 6, 6))
    covariance[:, _HEIGHTS, _HEIGHTS] = np.nan  # not known, and so correlated with nothing
    state[:, _PLACES] = ranges.state[rows]
    covariance[:, _PLACES[:, None], _PLACES] = ranges.covariance[rows]
    return Bodies(tracks.id[rows], tracks.time[rows], state, covariance)
