# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How one marker message is filled; what is alike in all of them is made once."""

from __future__ import annotations

from typing import Any

from msg_adapters.message_types import MessageTypes


class Brush:
    """Fill marker messages; parts that are alike in all of them are shared."""

    def __init__(self, header: Any, types: MessageTypes) -> None:
        self._header, self.types = header, types
        self._forever = types.Duration(sec=0, nanosec=0)
        self._image = types.CompressedImage(header=header, format='', data=types.to_bytes(b''))
        self._mesh = types.MeshFile(filename='', data=types.to_bytes(b''))
        self._origin = types.Point(x=0.0, y=0.0, z=0.0)
        self._upright = types.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
        self._unit = types.Vector3(x=1.0, y=1.0, z=1.0)
        self._white = types.ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)

    def marker(
        self,
        space: str,
        identity: int,
        kind: str,
        *,
        position: Any = None,
        turn: Any = None,
        scale: Any = None,
        color: Any = None,
        points: Any = (),
        colors: Any = (),
        text: str = '',
    ) -> Any:
        """Return a shape of this kind, or the action DELETE or DELETEALL."""
        Marker = self.types.Marker
        is_action = kind in ('DELETE', 'DELETEALL')
        return Marker(
            header=self._header, ns=space, id=identity % 2**31,
            type=Marker.ARROW if is_action else getattr(Marker, kind),
            action=getattr(Marker, kind) if is_action else Marker.ADD,
            pose=self.types.Pose(
                position=self._origin if position is None else self._vector('Point', position),
                orientation=self._upright if turn is None else self._turned(turn),
            ),
            scale=self._unit if scale is None else self._vector('Vector3', scale),
            color=self._white if color is None else self._paint(color),
            lifetime=self._forever, frame_locked=False,
            points=[self._vector('Point', point) for point in points],
            colors=[self._paint(values) for values in colors],
            texture_resource='', texture=self._image, uv_coordinates=[], text=text,
            mesh_resource='', mesh_file=self._mesh, mesh_use_embedded_materials=False,
        )  # fmt: skip

    def _vector(self, kind: str, values: Any) -> Any:
        x, y, z = values
        return getattr(self.types, kind)(x=x, y=y, z=z)

    def _turned(self, values: Any) -> Any:
        x, y, z, w = values
        return self.types.Quaternion(x=x, y=y, z=z, w=w)

    def _paint(self, values: Any) -> Any:
        r, g, b, a = values
        return self.types.ColorRGBA(r=r, g=g, b=b, a=a)
