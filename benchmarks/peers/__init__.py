# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do other trackers do on the same plots? Speed beside accuracy.

Read ``scenes`` (what is seen), ``ours``, ``stone_soup``, ``kalman_banks`` and ``nrl`` (who
tracks), ``race`` (scan by scan), ``judge`` (how well) and ``report`` (the tables) in this order.
"""
