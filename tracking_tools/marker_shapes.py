# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How marker messages look from above, as RViz would show them: one function per kind of shape."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from matplotlib.collections import LineCollection, TriMesh
from matplotlib.patches import Ellipse, Polygon
from matplotlib.tri import Triangulation
import numpy as np
from scipy.spatial.transform import Rotation

from tracking_core.batches import Floats

SHAFT, HEAD = 0.77, 2.0  # of an arrow: where its head begins, and how much wider it is
CORNERS = np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]]) / 2.0


def draw_markers(axes: Any, markers: Iterable[Any], points_per_metre: float) -> None:
    """
    Draw marker messages into a panel of matplotlib, lowest first.

    Parameters
    ----------
    axes : Axes
        Their coordinates are those of the tracking frame [m].
    markers : iterable of Marker
        Of any kind that our nodes send.
    points_per_metre : float
        For lines and letters, whose width is in metres.

    """
    for order, marker in enumerate(sorted(markers, key=lambda m: (_height(m), m.ns, m.id))):
        _KINDS[marker.type](axes, marker, points_per_metre, order)


def places(marker: Any) -> Floats:
    """Return where a marker is (K, 2) [m]: its corners, or its middle."""
    size = [marker.scale.x, marker.scale.y, marker.scale.z]
    is_flat = marker.type == marker.TRIANGLE_LIST
    return _placed(marker, _points(marker) * size if is_flat else np.zeros((1, 3)))


def _height(marker: Any) -> int:
    """Return the layer: flat and wide below, letters on top."""
    return {marker.TEXT_VIEW_FACING: 2, marker.LINE_STRIP: 1, marker.ARROW: 1}.get(marker.type, 0)


def _placed(marker: Any, points: Floats) -> Floats:
    """Return points (K, 3) of the marker's own axes as x, y (K, 2) of the frame."""
    p, q = marker.pose.position, marker.pose.orientation
    turned = Rotation.from_quat([q.x, q.y, q.z, q.w]).apply(points)
    return np.asarray(turned[:, :2] + np.array([p.x, p.y]))


def _rgba(color: Any) -> tuple[float, float, float, float]:
    return color.r, color.g, color.b, color.a


def _points(marker: Any) -> Floats:
    return np.array([[p.x, p.y, p.z] for p in marker.points], np.float64).reshape(-1, 3)


def _line(axes: Any, marker: Any, scale: float, order: int) -> None:
    way = _placed(marker, _points(marker))
    colours = np.array([_rgba(c) for c in marker.colors or [marker.color] * len(way)])
    axes.add_collection(
        LineCollection(
            np.stack([way[:-1], way[1:]], axis=1).tolist(),
            colors=0.5 * (colours[:-1] + colours[1:]),
            linewidths=max(marker.scale.x * scale, 0.6),
            zorder=order,
        )
    )


def _arrow(axes: Any, marker: Any, scale: float, order: int) -> None:
    length, width = marker.scale.x, 0.5 * marker.scale.y
    neck = SHAFT * length
    half = [[0, width], [neck, width], [neck, HEAD * width], [length, 0]]
    outline = np.array([*half, *[[x, -y] for x, y in reversed(half)]])
    axes.add_patch(
        Polygon(
            _placed(marker, np.pad(outline, ((0, 0), (0, 1)))),
            closed=True, color=_rgba(marker.color), linewidth=0.0, zorder=order,
        )
    )  # fmt: skip


def _ellipse(axes: Any, marker: Any, scale: float, order: int) -> None:
    q, s = marker.pose.orientation, marker.scale
    ahead = Rotation.from_quat([q.x, q.y, q.z, q.w]).apply([1.0, 0.0, 0.0])
    axes.add_patch(
        Ellipse(
            (marker.pose.position.x, marker.pose.position.y), s.x, s.y,
            angle=np.degrees(np.arctan2(ahead[1], ahead[0])),
            facecolor=_rgba(marker.color), linewidth=0.0, zorder=order,
        )
    )  # fmt: skip


def _box(axes: Any, marker: Any, scale: float, order: int) -> None:
    size = [marker.scale.x, marker.scale.y, 0.0]
    axes.add_patch(
        Polygon(
            _placed(marker, CORNERS * size), closed=True, facecolor=_rgba(marker.color),
            linewidth=0.0, zorder=order,
        )
    )  # fmt: skip


def _triangles(axes: Any, marker: Any, scale: float, order: int) -> None:
    size = [marker.scale.x, marker.scale.y, marker.scale.z]
    corners = _placed(marker, _points(marker) * size)
    colours = np.array([_rgba(c) for c in marker.colors or [marker.color] * len(corners)])
    colours[:, 3] *= marker.color.a if marker.colors else 1.0  # as RViz does
    threes = np.arange(len(corners)).reshape(-1, 3)
    mesh = TriMesh(Triangulation(corners[:, 0], corners[:, 1], threes))
    mesh.set_facecolor(colours.tolist())
    mesh.set_zorder(order)
    axes.add_collection(mesh)


def _letters(axes: Any, marker: Any, scale: float, order: int) -> None:
    p = marker.pose.position
    points = float(np.clip(marker.scale.z * scale, 5.0, 16.0))
    axes.text(
        p.x, p.y, marker.text, color=_rgba(marker.color), fontsize=points, ha='center',
        va='center', zorder=order, clip_on=True,
    )  # fmt: skip


# By the numbers of visualization_msgs/Marker.
_KINDS: dict[int, Callable[[Any, Any, float, int], None]] = {
    0: _arrow,
    1: _box,
    2: _ellipse,
    3: _ellipse,
    4: _line,
    9: _letters,
    11: _triangles,
}
