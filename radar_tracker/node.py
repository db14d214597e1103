# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
The radar tracker as a ROS node.

Subscribes to `plots` (PointCloud2), `ownship` (Odometry), `acquire` (PointStamped) and `cancel`
(UInt32); publishes `~/tracks` (PointCloud2), `~/odometry` (Odometry), `~/markers` (MarkerArray)
and `/diagnostics`; serves `~/reset` (Trigger). Parameters are those of ``config.py`` and
``node_config.py``.
"""

from __future__ import annotations

from collections.abc import Sequence
import sys

from msg_adapters.live.node import TrackerNode
from msg_adapters.node import run
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session


def make_node() -> TrackerNode:
    """Return the node, ready to spin."""
    configs = (RadarTrackerConfig(), radar_node_config())
    return TrackerNode('radar_tracker', configs, radar_session)


def main(args: Sequence[str] | None = None) -> int:
    """Run the radar node; return its exit code."""
    return run(make_node, args)


if __name__ == '__main__':
    sys.exit(main())
