# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Targets of a marine radar (NMEA 0183: TTM, TLL) as plots."""
