# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How sonar tracks are drawn: fans from where the sensor is, their mirror images, gates and ids.

A fan is a few triangles, scaled, that fade outwards: how far the contact is, nobody knows. Where
the range is known, position and velocity are drawn too, as those of radar tracks.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.brush import Brush
from msg_adapters.message_types import MessageTypes
from msg_adapters.shapes import (
    arrows,
    colours,
    Drawing,
    ellipses,
    erase,
    LETTER,
    SIGMAS,
)
from tracking_core.batches import Floats, Tracks

LOCATED = ('velocity', 'covariance')
NAMESPACES = ('fan', 'mirror', 'gate', 'id', *LOCATED)
OPACITY = {'fan': 0.7, 'mirror': 0.25, 'gate': 0.22}
NARROWEST, WIDEST = 2e-3, 1.2  # half widths that can be seen, and that are still fans [rad]
SLICES = 6  # triangles of a fan
FADED = 0.4  # of the opacity is left at the end


@dataclass(frozen=True)
class Fans:
    """Where sonar tracks are to be drawn."""

    bearing: Floats  # (T,) [rad]
    bearing_sd: Floats  # (T,) [rad]
    gate: Floats  # (T,) half size [rad]
    origin: tuple[float, float, float]  # of the sensor [m]
    axis: float | None  # of an array that cannot tell left from right [rad]
    length: float  # [m]


def to_fan_markers(
    tracks: Tracks,
    fans: Fans,
    located: Bodies,
    shown: Set[int],
    header: Any,
    types: MessageTypes,
    *,
    lead_time: float,
) -> Any:
    """
    Return the MarkerArray of all tracks.

    Parameters
    ----------
    tracks : Tracks
        What is drawn; tentative tracks are pale.
    fans : Fans
        Row by row.
    located : Bodies
        Those tracks whose range is known.
    shown : set of int
        Ids drawn before; those that are gone are deleted.
    header : Header
        Of the cycle, in the tracking frame.
    types : MessageTypes
        Classes to build the message from.
    lead_time : float
        Arrows end where the contacts will be after this time [s].

    """
    brush = Brush(header, types)
    colour = colours(tracks.id, tracks.confirmed)
    known = np.isin(tracks.id, located.id)
    drawing = Drawing(located, colour[known], fans.length)
    narrow = SIGMAS * fans.bearing_sd
    parts = [
        erase(shown, tracks.id, NAMESPACES, brush),
        erase(shown & set(tracks.id[~known].tolist()), located.id, LOCATED, brush),
        _fans('fan', fans.bearing, narrow, tracks, fans, colour, brush),
        _fans('gate', fans.bearing, fans.gate, tracks, fans, colour, brush),
        _labels(tracks, fans, colour, brush),
        arrows(drawing, brush, lead_time),
        ellipses(drawing, brush),
    ]
    if fans.axis is not None:
        mirrored = 2.0 * fans.axis - fans.bearing
        parts.append(_fans('mirror', mirrored, narrow, tracks, fans, colour, brush))
    return types.MarkerArray(markers=list(chain.from_iterable(parts)))


def _fans(
    space: str,
    bearing: Floats,
    half_width: Floats,
    tracks: Tracks,
    fans: Fans,
    colour: Floats,
    brush: Brush,
) -> Iterator[Any]:
    """Yield a fan for each track; none where its width is not known."""
    half_width = np.clip(half_width, NARROWEST, WIDEST)
    aside = fans.length * np.tan(half_width)
    zero, half = np.zeros(len(bearing)), 0.5 * bearing
    turn = np.stack([zero, zero, np.sin(half), np.cos(half)], axis=1)
    scale = np.stack([np.full(len(bearing), fans.length), aside, np.ones(len(bearing))], axis=1)
    near = colour * [1.0, 1.0, 1.0, OPACITY[space]]
    far = near * [1.0, 1.0, 1.0, FADED]
    solid = np.column_stack([colour[:, :3], np.ones(len(colour))])  # viewers multiply
    columns = tracks.id, turn, scale, solid, _slices(half_width), near, far
    rows = (values.tolist() for values in columns)
    for identity, toward, size, paint, points, begin, end in zip(*rows, strict=True):
        if np.isfinite(size[1]):
            yield brush.marker(
                space, identity, 'TRIANGLE_LIST', position=fans.origin, turn=toward, scale=size,
                color=paint, points=points, colors=[begin, end, end] * SLICES,
            )  # fmt: skip
        else:
            yield brush.marker(space, identity, 'DELETE')


def _slices(half_width: Floats) -> Floats:
    """Return the corners (T, 3 K, 3) in the fan's own axes, before scaling; (1, 1) is a corner."""
    angle = half_width[:, None] * np.linspace(-1.0, 1.0, SLICES + 1)
    arc = np.stack([np.cos(angle), np.sin(angle) / np.tan(half_width[:, None])], axis=2)
    corners = np.zeros((len(half_width), SLICES, 3, 3))
    corners[:, :, 1, :2], corners[:, :, 2, :2] = arc[:, :-1], arc[:, 1:]
    return corners.reshape(len(half_width), 3 * SLICES, 3)


def _labels(tracks: Tracks, fans: Fans, colour: Floats, brush: Brush) -> Iterator[Any]:
    """Yield the ids, a little beyond the ends of the fans."""
    letter = 2.0 * LETTER * fans.length
    line = np.stack([np.cos(fans.bearing), np.sin(fans.bearing), 0.0 * fans.bearing], axis=1)
    place = np.array(fans.origin) + (fans.length + letter) * line
    rows = (values.tolist() for values in (tracks.id, place, colour))
    for identity, end, fill in zip(*rows, strict=True):
        yield brush.marker(
            'id', identity, 'TEXT_VIEW_FACING', position=end, scale=[0.0, 0.0, letter], color=fill,
            text=str(identity),
        )  # fmt: skip
