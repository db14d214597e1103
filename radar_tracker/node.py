# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
The radar tracker as a ROS node.

Subscribes to `plots` (PointCloud2), `ownship` (Odometry), `acquire` (PointStamped) and `cancel`
(UInt32); publishes `~/tracks` (PointCloud2), `~/odometry` (Odometry), `~/markers` (MarkerArray),
`~/radar_tracks` (RadarTracks, if asked for) and `/diagnostics`; serves `~/reset` (Trigger).

    radar_tracker --ros-args -r plots:=/my_radar/points --params-file config/marine_radar.yaml
"""

from __future__ import annotations

from collections.abc import Sequence
import sys

from tracking_node.start import start


def main(args: Sequence[str] | None = None) -> int:
    """Run the radar node; return its exit code."""
    # What it is made of is in live.py, its parameters in config.py and node_config.py.
    return start('radar_tracker.live', __doc__, args)


if __name__ == '__main__':
    sys.exit(main())
