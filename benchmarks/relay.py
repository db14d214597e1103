# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The least that a node in the middle can do: it sends on what it hears, from `in` to `out`."""

import sys

from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import PointCloud2

from tracking_node.endpoints import subscribe
from tracking_node.run import run


class Relay(Node):
    """Subscribes to `in` and publishes on `out` (PointCloud2), with the QoS of the trackers."""

    def __init__(self) -> None:
        super().__init__('relay')
        publisher = self.create_publisher(PointCloud2, 'out', QoSProfile(depth=10))
        subscribe(self, PointCloud2, 'in', publisher.publish)


if __name__ == '__main__':
    sys.exit(run(Relay))
