# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What radars and ships send without ROS, as plots. Read ``report.py``, then ``feed.py``."""
