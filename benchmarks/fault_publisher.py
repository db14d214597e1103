# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The radar or the ship of ``fault_scene.py`` as a process of its own, to be killed."""

from __future__ import annotations

import os
import sys
import time
from typing import Any

from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2

from benchmarks.fault_scene import Scene
from benchmarks.fault_stage import PERIOD
from msg_adapters.message_types import rclpy_types
from msg_adapters.table import from_columns
from tracking_tools.testing import Peer


def publish(what: str, scene: Scene) -> None:
    """Publish in real time until the end of the process."""
    with Peer(int(os.environ['ROS_DOMAIN_ID']), f'{what}_source') as peer:
        publisher: Any = peer.tell(PointCloud2 if what == 'plots' else Odometry, what)
        while True:
            now = time.time()
            if what == 'plots':
                publisher.publish(from_columns(scene.plots(now), now, 'radar', rclpy_types()))
            else:
                publisher.publish(scene.odometry(now))
            peer.spin(lambda: False, PERIOD - time.time() % PERIOD)


if __name__ == '__main__':
    publish(sys.argv[1], Scene(float(sys.argv[2]), is_afloat=sys.argv[3] == 'afloat'))
