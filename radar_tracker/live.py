# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the radar node is made of, and how it runs; ``node.py`` is its program."""

from __future__ import annotations

from collections.abc import Sequence

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_node.run import run
from tracking_node.tracker_node import TrackerNode


def make_node() -> TrackerNode:
    """Return the node, ready to spin."""
    configs = (RadarTrackerConfig(), radar_node_config())
    return TrackerNode('radar_tracker', configs, radar_session)


def main(args: Sequence[str] | None = None) -> int:
    """Run the radar node; return its exit code."""
    return run(make_node, args)
