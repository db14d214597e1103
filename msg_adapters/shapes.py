# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How shapes are drawn around contacts, in a colour of their own.

Shapes are scaled rather than made of points. Poses, sizes and colours of all contacts are computed
at once, then each message is filled.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass
from typing import Any

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.brush import Brush
from msg_adapters.message_types import MessageTypes
from tracking_core.batches import Bools, Floats, Ints

SIGMAS = 3.0  # half axes of the covariance ellipse
# Of hue and of whiteness from one id to the next: neighbours differ most (R2 sequence).
HUE_STEP, WHITE_STEP = 0.7548777, 0.5698403
PALE = 0.4  # opacity of what is tentative
# Widths and letters, as a share of how far the contacts are spread.
THIN, LETTER = 0.0007, 0.012
ASIDE = 1.2  # heights of a letter between a contact and its id
OPACITY = {'covariance': 0.55, 'gate': 0.22}
FLAT = 0.01  # m, height of what lies in the plane; RViz refuses 0


@dataclass(frozen=True)
class Drawing:
    """What the parts of a drawing have in common, one row per contact."""

    bodies: Bodies
    colour: Floats  # (T, 4) red, green, blue, opacity
    extent: float  # about how far the contacts are from the origin [m]


def erase_all(header: Any, types: MessageTypes) -> Any:
    """Return the MarkerArray that deletes everything drawn so far."""
    return types.MarkerArray(markers=[Brush(header, types).marker('', 0, 'DELETEALL')])


def erase(shown: Set[int], ids: Ints, spaces: tuple[str, ...], brush: Brush) -> list[Any]:
    """Return what deletes in these name spaces what was shown and is none of the ids (T,)."""
    return [
        brush.marker(space, identity, 'DELETE')
        for identity in sorted(shown - set(ids.tolist()))
        for space in spaces
    ]


def colours(ids: Ints, confirmed: Bools) -> Floats:
    """Return a bright colour (T, 4) for each id, pale while tentative."""
    hue, white = ids * HUE_STEP % 1.0, 0.2 + 0.4 * (ids * WHITE_STEP % 1.0)
    third = np.array([0.0, 1.0, 2.0]) / 3.0
    rgb = np.clip(np.abs((hue[:, None] + third) % 1.0 * 6.0 - 3.0) - 1.0, 0.0, 1.0)
    return np.column_stack([white[:, None] + (1.0 - white[:, None]) * rgb, _opacity(confirmed)])


def _opacity(confirmed: Bools) -> Floats:
    return np.where(confirmed, 1.0, PALE)


def round_extent(position: Floats) -> float:
    """Return a power of two beyond all positions (T, 3) [m]: letters grow in steps, seldom."""
    farthest = float(np.abs(position).max(initial=1.0))
    return float(2.0 ** np.ceil(np.log2(farthest))) if np.isfinite(farthest) else 1.0


def rows(drawing: Drawing, *columns: Any) -> Iterator[tuple[Any, ...]]:
    """Yield id, position and these columns of each contact as plain Python values."""
    plain = [
        column.tolist() for column in (drawing.bodies.id, drawing.bodies.state[:, :3], *columns)
    ]
    return zip(*plain, strict=True)


def arrows(drawing: Drawing, brush: Brush, lead_time: float) -> Iterator[Any]:
    """Yield arrows that end where the contacts will be after the lead time [s]."""
    vx, vy, vz = drawing.bodies.state[:, 3:].T
    speed = np.hypot(vx, vy)
    half_yaw, half_pitch = 0.5 * np.arctan2(vy, vx), -0.5 * np.arctan2(vz, speed)
    turn = np.stack(
        [
            -np.sin(half_yaw) * np.sin(half_pitch),
            np.cos(half_yaw) * np.sin(half_pitch),
            np.sin(half_yaw) * np.cos(half_pitch),
            np.cos(half_yaw) * np.cos(half_pitch),
        ],
        axis=1,
    )
    length = np.maximum(np.hypot(speed, vz) * lead_time, FLAT)
    width = 3.0 * THIN * drawing.extent
    for identity, place, toward, ahead, colour in rows(drawing, turn, length, drawing.colour):
        yield brush.marker(
            'velocity', identity, 'ARROW', position=place, turn=toward,
            scale=[ahead, width, width], color=colour,
        )  # fmt: skip


def ellipses(drawing: Drawing, brush: Brush) -> Iterator[Any]:
    """Yield the covariance of each position, out to three sigma."""
    return _ellipses(
        drawing, brush, 'covariance', SIGMAS**2 * drawing.bodies.covariance[:, :3, :3]
    )


def gates(drawing: Drawing, brush: Brush, half_size: Floats, lean: Floats) -> Iterator[Any]:
    """Yield the gates: half sizes (T, 2) or (T, 3) [m], and how x goes with y in them (T,)."""
    shape = np.zeros((len(lean), 3, 3))
    axes = np.arange(half_size.shape[1])
    shape[:, axes, axes] = half_size**2
    shape[:, 0, 1] = shape[:, 1, 0] = lean * half_size[:, 0] * half_size[:, 1]
    return _ellipses(drawing, brush, 'gate', shape)


def _ellipses(drawing: Drawing, brush: Brush, space: str, shape: Floats) -> Iterator[Any]:
    """Yield see-through ellipses, by the squares of their half axes (T, 3, 3); none if unknown."""
    # Closed form of two by two: it never fails, whatever the numbers.
    (a, b), c = shape[:, 0, :2].T, shape[:, 1, 1]
    half_yaw, middle = 0.25 * np.arctan2(2.0 * b, a - c), 0.5 * (a + c)
    spread = np.hypot(0.5 * (a - c), b)
    zero = np.zeros(len(half_yaw))
    turn = np.stack([zero, zero, np.sin(half_yaw), np.cos(half_yaw)], axis=1)
    squares = np.stack([middle + spread, middle - spread, np.nan_to_num(shape[:, 2, 2])], axis=1)
    size = np.maximum(2.0 * np.sqrt(np.maximum(squares, 0.0)), FLAT)
    colour = drawing.colour * [1.0, 1.0, 1.0, OPACITY[space]]
    for identity, place, toward, scale, paint in rows(drawing, turn, size, colour):
        if np.isfinite(scale).all():
            yield brush.marker(
                space, identity, 'SPHERE', position=place, turn=toward, scale=scale, color=paint
            )
        else:
            yield brush.marker(space, identity, 'DELETE')


def labels(drawing: Drawing, brush: Brush) -> Iterator[Any]:
    """Yield the ids, to port of the contacts, where neither trail nor arrow is."""
    letter = LETTER * drawing.extent
    vx, vy = drawing.bodies.state[:, 3:5].T
    course = np.arctan2(vy, vx)
    aside = np.stack([-np.sin(course), np.cos(course), 0.0 * course], axis=1)
    place_of = drawing.bodies.state[:, :3] + ASIDE * letter * aside
    for identity, _, place, colour in rows(drawing, place_of, drawing.colour):
        yield brush.marker(
            'id', identity, 'TEXT_VIEW_FACING', position=place, scale=[0.0, 0.0, letter],
            color=colour, text=str(identity),
        )  # fmt: skip
