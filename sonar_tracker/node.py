# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
The sonar tracker as a ROS node.

Subscribes to `bearings` (PointCloud2), `ownship` (Odometry), `acquire` (PointStamped) and `cancel`
(UInt32); publishes `~/tracks` (PointCloud2), `~/odometry` (Odometry, of contacts whose range is
known), `~/markers` (MarkerArray) and `/diagnostics`; serves `~/reset` (Trigger). Parameters are
those of ``config.py`` and ``node_config.py``.
"""

from __future__ import annotations

from collections.abc import Sequence
import sys

from msg_adapters.live.node import TrackerNode
from msg_adapters.node import run
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session


def make_node() -> TrackerNode:
    """Return the node, ready to spin."""
    configs = (SonarTrackerConfig(), sonar_node_config())
    return TrackerNode('sonar_tracker', configs, sonar_session)


def main(args: Sequence[str] | None = None) -> int:
    """Run the sonar node; return its exit code."""
    return run(make_node, args)


if __name__ == '__main__':
    sys.exit(main())
