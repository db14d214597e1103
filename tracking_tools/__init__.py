# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What works on recordings and scenarios: simulate, replay, evaluate, report."""
