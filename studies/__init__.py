# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One script per paper: regenerates its table into ``docs/results``; read ``zhuk_2009.py``."""
