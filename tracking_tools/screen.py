# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What stands on a viewer's screen after all the MarkerArrays that it has received?"""

from __future__ import annotations

from typing import Any

Key = tuple[str, int]  # namespace and id


class Screen:
    """Keep markers as RViz does: ADD replaces, DELETE takes away, DELETEALL clears."""

    def __init__(self) -> None:
        self.markers: dict[Key, Any] = {}
        self.stamp: tuple[int, int] | None = None  # sec, nanosec of the newest marker

    def take(self, msg: Any) -> None:
        """Follow one MarkerArray."""
        for marker in msg.markers:
            key, stamp = (marker.ns, marker.id), marker.header.stamp
            self.stamp = (stamp.sec, stamp.nanosec)
            if marker.action == marker.ADD:
                self.markers[key] = marker
            elif marker.action == marker.DELETE:
                self.markers.pop(key, None)
            elif marker.action == marker.DELETEALL:
                self.markers.clear()

    def take_all(self, messages: list[Any]) -> tuple[int, int] | None:
        """Follow all of these MarkerArrays, empty the list, and return the newest stamp."""
        for msg in messages:
            self.take(msg)
        messages.clear()
        return self.stamp

    def ids(self) -> set[int]:
        """Return whose shapes are there."""
        return {identity for _, identity in self.markers}
