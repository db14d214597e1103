# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a tracker knew when its node ended, kept in a file. Read ``keeper.py`` first."""
