# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Test a ROS graph with our trackers in it: real nodes, real processes, deadlines instead of sleep.

``docs/testing.md`` has an example to copy. Read ``probe.py`` first.
"""

from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns
from tracking_tools.node_process import NodeFailed, NodeProcess, private_domain, python_node
from tracking_tools.peer import Peer
from tracking_tools.testing.play import play
from tracking_tools.testing.probe import confirmed_ids, TrackerProbe
from tracking_tools.testing.synthetic import RADAR, SONAR, SyntheticSensor

__all__ = [
    'RADAR',
    'SONAR',
    'NodeFailed',
    'NodeProcess',
    'Peer',
    'SyntheticSensor',
    'TrackerProbe',
    'confirmed_ids',
    'play',
    'private_domain',
    'python_node',
    'rclpy_types',
    'to_columns',
]
