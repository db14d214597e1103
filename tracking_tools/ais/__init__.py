# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ships that report their position by AIS, as plots."""
