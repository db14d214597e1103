# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the detections of a vision_msgs/Detection3DArray become columns."""

from __future__ import annotations

from typing import Any

from msg_adapters.kinds.poses import positions
from msg_adapters.table import Columns


def detections_3d(msg: Any) -> Columns:
    """Return x, y and z [m] of the best hypothesis of each detection, of its box without one."""
    return positions([_position(one) for one in msg.detections])


def _position(detection: Any) -> Any:
    if len(detection.results) == 0:
        return detection.bbox.center.position
    best = max(detection.results, key=lambda result: result.hypothesis.score)
    return best.pose.pose.position
