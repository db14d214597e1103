# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
A tracker in a ROS graph, whatever its sensor: parameters, lifecycle, topics, diagnostics.

Read ``tracker_node.py`` (parameters and lifecycle), then ``topics.py``.
"""
