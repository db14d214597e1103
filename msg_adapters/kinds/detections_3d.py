# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the detections of a vision_msgs/Detection3DArray become columns."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.kinds.poses import positions
from msg_adapters.position_noise import covariance_columns
from msg_adapters.table import Columns

NOT_TOLD = np.zeros(36)


def detections_3d(msg: Any) -> Columns:
    """
    Return x, y, z [m] and their covariance from the best hypothesis of each detection.

    Without a hypothesis, or with one whose position was left at 0, the box says where it is; how
    sure that is only a hypothesis says.
    """
    poses = [_best(one) for one in msg.detections]
    return {
        **positions([pose.position for pose, _ in poses]),
        **covariance_columns([covariance for _, covariance in poses]),
    }


def _best(detection: Any) -> tuple[Any, Any]:
    """Return pose and covariance (36,)."""
    if len(detection.results) == 0:
        return detection.bbox.center, NOT_TOLD
    best = max(detection.results, key=lambda result: result.hypothesis.score).pose
    p = best.pose.position
    is_told = any((p.x, p.y, p.z))
    return best.pose if is_told else detection.bbox.center, best.covariance
