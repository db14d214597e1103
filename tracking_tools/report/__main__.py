# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Run ``python -m tracking_tools.report``."""

import sys

from tracking_tools.report.command import main

sys.exit(main())
