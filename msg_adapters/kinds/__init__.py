# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Messages other than PointCloud2 as named columns, one file each. Read ``menu.py`` first."""
