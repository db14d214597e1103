# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What a message may do at all, whatever the sensor: stamps, frames, own ship, late plots, counts.

Without a ROS graph: a node hands over what it hears, a replay what a bag has. Read ``session.py``
first.
"""
