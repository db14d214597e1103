# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How radar tracks are drawn: a trail that fades, velocity, covariance, gate and id.

Only the trail is a line; the shapes are those of ``shapes.py``.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from itertools import chain
from typing import Any

import numpy as np

from msg_adapters.brush import Brush
from msg_adapters.message_types import MessageTypes
from msg_adapters.shapes import (
    arrows,
    colours,
    Drawing,
    ellipses,
    erase,
    gates,
    labels,
    round_extent,
    rows,
    THIN,
)
from msg_adapters.tracks import to_bodies
from msg_adapters.trails import Trails
from tracking_core.batches import Floats, Tracks

NAMESPACES = ('history', 'velocity', 'covariance', 'gate', 'id')


def to_markers(
    tracks: Tracks,
    trails: Trails,
    shown: Set[int],
    header: Any,
    types: MessageTypes,
    *,
    lean: Floats,
    output: str,
    lead_time: float,
) -> Any:
    """
    Return the MarkerArray of all tracks.

    Parameters
    ----------
    tracks : Tracks
        What is drawn; tentative tracks are pale.
    trails : Trails
        Where they were.
    shown : set of int
        Ids drawn before; those that are gone are deleted.
    header : Header
        Of the scan, in the tracking frame.
    types : MessageTypes
        Classes to build the message from.
    lean : (T,) array
        Correlation of x and y in the gates.
    output : str
        'mmse' or 'map'.
    lead_time : float
        The arrow ends where the contact will be after this time [s].

    """
    brush = Brush(header, types)
    markers = erase(shown, tracks.id, NAMESPACES, brush)
    if len(tracks):
        bodies = to_bodies(tracks, output)
        extent = round_extent(bodies.state[:, :3])
        drawing = Drawing(bodies, colours(tracks.id, tracks.confirmed), extent)
        parts = (
            _histories(drawing, brush, trails),
            arrows(drawing, brush, lead_time),
            ellipses(drawing, brush),
            gates(drawing, brush, tracks.gate_size, lean),
            labels(drawing, brush),
        )
        markers.extend(chain.from_iterable(parts))
    return types.MarkerArray(markers=markers)


def _histories(drawing: Drawing, brush: Brush, trails: Trails) -> Iterator[Any]:
    """Yield the trails, newest point first, from the colour of the track to nothing."""
    width = [THIN * drawing.extent, 0.0, 0.0]
    position = trails.of(drawing.bodies.id)
    known = np.isfinite(position[:, :, 0]).sum(axis=1)
    fade = 1.0 - np.arange(position.shape[1]) / position.shape[1]
    for row, (identity, _, count, colour) in enumerate(rows(drawing, known, drawing.colour)):
        if count > 1:
            *rgb, opacity = colour
            yield brush.marker(
                'history', identity, 'LINE_STRIP', scale=width, color=colour,
                points=position[row, :count].tolist(),
                colors=[[*rgb, opacity * share] for share in fade[:count].tolist()],
            )  # fmt: skip
