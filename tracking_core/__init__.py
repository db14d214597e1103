# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""ROS-free mathematics of tracking; read ``batches``, ``tracker`` and ``update`` first."""
