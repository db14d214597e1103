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
GOLDEN = 0.618034  # of a turn of hue between two ids: neighbours differ most
# Widths and letters, as a share of how far the contacts are spread.
THIN, LETTER = 0.001, 0.012
OPACITY = {'covariance': 0.5, 'gate': 0.15}
FLAT = 0.01  # m, height of what lies in the plane; RViz refuses 0


@dataclass(frozen=True)
class Look:
    """What the parts of a drawing have in common, one row per contact."""

    bodies: Bodies
    colour: Floats  # (T, 4) red, green, blue, opacity
    extent: float  # how far the contacts are from the origin [m]


def erase_all(header: Any, types: MessageTypes) -> Any:
    """Return the MarkerArray that deletes everything drawn so far."""
    return types.MarkerArray(markers=[Brush(header, types).marker('', 0, 'DELETEALL')])


def erase(shown: Set[int], ids: Ints, spaces: tuple[str, ...], brush: Brush) -> list[Any]:
    """Return what deletes the shapes of ids that were shown and are gone."""
    return [
        brush.marker(space, identity, 'DELETE')
        for identity in sorted(shown - set(ids.tolist()))
        for space in spaces
    ]


def colours(ids: Ints, confirmed: Bools) -> Floats:
    """Return a bright colour (T, 4) for each id, pale while tentative."""
    hue = (ids * GOLDEN) % 1.0
    third = np.array([0.0, 1.0, 2.0]) / 3.0
    rgb = np.clip(np.abs((hue[:, None] + third) % 1.0 * 6.0 - 3.0) - 1.0, 0.0, 1.0)
    opacity = np.where(confirmed, 1.0, 0.4)
    return np.column_stack([0.25 + 0.75 * rgb, opacity])


def rows(look: Look, *columns: Any) -> Iterator[tuple[Any, ...]]:
    """Yield id, position and these columns of each contact as plain Python values."""
    plain = [column.tolist() for column in (look.bodies.id, look.bodies.state[:, :3], *columns)]
    return zip(*plain, strict=True)


def arrows(look: Look, brush: Brush, lead_time: float) -> Iterator[Any]:
    """Yield arrows that end where the contacts will be after the lead time [s]."""
    vx, vy, vz = look.bodies.state[:, 3:].T
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
    width = 4.0 * THIN * look.extent
    for identity, place, toward, ahead, colour in rows(look, turn, length, look.colour):
        yield brush.marker(
            'velocity', identity, 'ARROW', position=place, turn=toward,
            scale=[ahead, width, width], color=colour,
        )  # fmt: skip


def ellipses(look: Look, brush: Brush) -> Iterator[Any]:
    """Yield the covariance of each position."""
    # Closed form of two by two: it never fails, whatever the numbers.
    (a, b), c = look.bodies.covariance[:, 0, :2].T, look.bodies.covariance[:, 1, 1]
    half_yaw, middle = 0.25 * np.arctan2(2.0 * b, a - c), 0.5 * (a + c)
    spread = np.hypot(0.5 * (a - c), b)
    zero = np.zeros(len(half_yaw))
    turn = np.stack([zero, zero, np.sin(half_yaw), np.cos(half_yaw)], axis=1)
    height = np.nan_to_num(look.bodies.covariance[:, 2, 2])
    variances = np.stack([middle + spread, middle - spread, height], axis=1)
    size = np.maximum(2.0 * SIGMAS * np.sqrt(np.maximum(variances, 0.0)), FLAT)
    return shapes(look, brush, 'covariance', kind='SPHERE', turn=turn, size=size)


def shapes(
    look: Look, brush: Brush, space: str, *, kind: str, turn: Floats, size: Floats
) -> Iterator[Any]:
    """Yield a see-through shape around each contact; none where the size is not known."""
    colour = look.colour * [1.0, 1.0, 1.0, OPACITY[space]]
    for identity, place, toward, scale, paint in rows(look, turn, size, colour):
        if np.isfinite(scale).all():
            yield brush.marker(
                space, identity, kind, position=place, turn=toward, scale=scale, color=paint
            )


def labels(look: Look, brush: Brush) -> Iterator[Any]:
    """Yield the ids."""
    letter = LETTER * look.extent
    above = look.bodies.state[:, :3] + [0.0, letter, 0.0]
    for identity, _, place, colour in rows(look, above, look.colour):
        yield brush.marker(
            'id', identity, 'TEXT_VIEW_FACING', position=place, scale=[0.0, 0.0, letter],
            color=colour, text=str(identity),
        )  # fmt: skip
