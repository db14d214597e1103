# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What a tracker does in a ROS graph, whatever its sensor.

Read ``node.py`` (parameters and lifecycle), then ``topics.py``.
"""
