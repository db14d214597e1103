# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""ASTERIX CAT048 as plots, from a file or from UDP."""
