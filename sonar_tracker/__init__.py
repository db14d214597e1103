# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Bearings of a sonar become tracks. Read ``tracker.py`` first, then ``config.py``."""
