# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Radar plots to tracks; ``config.py`` has the parameters, ``node.py`` the ROS node."""
