# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots without height, by hand: from a radar that is not in the origin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

from tracking_core.batches import Coverage, Floats, Scan
from tracking_core.slant import farther_out, over_ground

RADAR = np.array([1000.0, -2000.0, 50.0])


def scan_of(position: Floats) -> Scan:
    """Return plots at these places, those without height at their slant range."""
    M = len(position)
    return Scan(
        time=np.zeros(M), position=position, covariance=np.tile(np.eye(3), (M, 1, 1)),
        range_rate=np.full(M, np.nan), range_rate_variance=np.ones(M), snr=np.full(M, np.nan),
        clutter_volume=np.ones(M), sensor_position=np.tile(RADAR, (M, 1)),
        sensor_velocity=np.zeros((M, 3)), volume=1.0, is_slant=True,
        coverage=Coverage(0.0, 0.0, sensor_position=tuple(RADAR.tolist())),
    )  # fmt: skip


def test_plot_without_height_is_brought_in_to_where_it_is() -> None:
    """Five kilometres of slant range at 3 km above the radar are four over the ground."""
    seen = RADAR + np.array([[3000.0, 4000.0, np.nan], [3000.0, 4000.0, 3000.0]])
    scan, rows = scan_of(seen), np.array([1, 0])
    found = over_ground(seen[rows], rows, np.full(2, 3050.0), scan)
    expected = np.array([[3000.0, 4000.0, 3000.0], [2400.0, 3200.0, np.nan]])
    assert_allclose(found, RADAR + expected)
    near = np.vstack([seen[:1], RADAR])
    near[1, 2] = np.nan
    before = near.copy()
    above = over_ground(near, np.zeros(2, np.int64), np.full(2, 9e3), scan)
    assert_allclose(above[:, :2], RADAR[None, :2].repeat(2, axis=0))
    assert_allclose(near, before)
    beside = replace(scan, is_slant=False)
    assert_allclose(over_ground(seen[rows], rows, np.full(2, 3050.0), beside), seen[rows])


def test_farther_out_is_slant_range_less_ground_range() -> None:
    """Three up and four along the ground: five, one too far; nothing where all have heights."""
    tracks = RADAR + np.array([[2400.0, 3200.0, 3000.0], [-300.0, 0.0, 400.0]])
    one = RADAR + np.array([[0.0, 1.0, np.nan], [0.0, 1.0, 1.0]])
    assert_allclose(farther_out(tracks, scan_of(one)), [1000.0, 200.0])
    assert_allclose(farther_out(tracks, scan_of(one[1:])), [0.0, 0.0])
