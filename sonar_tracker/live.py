# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the sonar node is made of, and how it runs; ``node.py`` is its program."""

from __future__ import annotations

from collections.abc import Sequence

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_node.run import run
from tracking_node.tracker_node import TrackerNode


def make_node() -> TrackerNode:
    """Return the node, ready to spin."""
    configs = (SonarTrackerConfig(), sonar_node_config())
    return TrackerNode('sonar_tracker', configs, sonar_session)


def main(args: Sequence[str] | None = None) -> int:
    """Run the sonar node; return its exit code."""
    return run(make_node, args)
