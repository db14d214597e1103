# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
The sonar tracker as a ROS node.

Subscribes to `bearings` (PointCloud2), `ownship` (Odometry), `acquire` (PointStamped) and `cancel`
(UInt32); publishes `~/tracks` (PointCloud2), `~/odometry` (Odometry, of contacts whose range is
known), `~/markers` (MarkerArray), `~/radar_tracks` (RadarTracks, if asked for) and `/diagnostics`;
serves `~/reset` (Trigger).

    sonar_tracker --ros-args -r bearings:=/my_array/marks --params-file config/sonar.yaml
"""

from __future__ import annotations

from collections.abc import Sequence
import sys

from tracking_node.start import start


def main(args: Sequence[str] | None = None) -> int:
    """Run the sonar node; return its exit code."""
    # What it is made of is in live.py, its parameters in config.py and node_config.py.
    return start('sonar_tracker.live', __doc__, args)


if __name__ == '__main__':
    sys.exit(main())
