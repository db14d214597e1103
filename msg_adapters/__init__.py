# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Every crossing between ROS messages and the core, and nothing else. Read ``table.py`` first."""
