# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where a mounted radar is, where it looks, and how far its antenna turns on a turning ship."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.antenna import Sweep
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.mounting import coverage_of
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.platform import Platform


def ship(*headings: float) -> Platform:
    """Own ship at (300, 400) m with a heading every second."""
    K, half = len(headings), 0.5 * np.array(headings)
    turn = np.stack([0.0 * half, 0.0 * half, np.sin(half), np.cos(half)], axis=1)
    place = np.tile([300.0, 400.0, 0.0], (K, 1))
    return Platform(
        np.arange(K, dtype=float), place, turn, 0.0 * place, np.zeros((K, 3, 3)), np.zeros(K),
        max_extrapolation=1e3,
    )  # fmt: skip


@pytest.mark.parametrize('yaw', [0.0, 0.3])
def test_radar_on_land_stands_where_its_mount_says(yaw: float) -> None:
    """Without own ship the mount is in the tracking frame."""
    values = {'scan.assembly': 'snapshot', 'sensor.mount.x': 1000.0, 'sensor.mount.y': -500.0}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**values, 'sensor.mount.yaw': yaw}))
    for number in range(3):
        plots = Plots.polar(np.full(1, 4.0 * number), np.full(1, 8_000.0), np.full(1, 0.7))
        tracks = tracker.track(replace(plots, stamp=4.0 * number))
    assert_allclose(tracker.sensor_position, (1000.0, -500.0, 0.0))
    expected = [1000.0 + 8_000.0 * np.cos(0.7 + yaw), -500.0 + 8_000.0 * np.sin(0.7 + yaw)]
    assert_allclose(tracks.planes[0].average[0, 0::2], expected, atol=1.0)


@pytest.mark.parametrize(('place', 'is_inside'), [((300.0, 9_000.0), True),
                                                  ((9_000.0, 400.0), False)])  # fmt: skip
def test_sector_of_a_radar_turns_with_its_ship(place, is_inside: bool) -> None:
    """Ahead of a ship to the north; what is abeam is not missed."""
    values = {'scan.assembly': 'snapshot', 'sensor.sector_width': 1.0, 'sensor.dimensions': 2}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    nothing, north = Plots.polar(np.zeros(0), np.zeros(0), np.zeros(0)), ship(0.5 * np.pi)
    for time in (0.0, 4.0, 8.0):
        tracker.track(replace(nothing, stamp=time), north)
        if time == 0.0:
            tracker.start_track(np.array(place), time)
    existence = tracker.tracks.existence_probability
    assert (existence < 0.95) if is_inside else (existence > 0.99)


@pytest.mark.parametrize('heading', [1.0, np.pi - 0.05])
@pytest.mark.parametrize('angle', [2.0 * np.pi, -2.0 * np.pi])
def test_antenna_turns_with_the_ship_across_the_wrap(heading, angle) -> None:
    """A tenth of a radian to port in one turn, also where the heading jumps by a whole one."""
    sweep = Sweep(0.0, 1.0, start_azimuth=0.4, angle=angle)
    ends = ship(heading, heading + 0.1).at(np.array([0.0, 1.0]))
    coverage = coverage_of(sweep, ends, RadarTrackerConfig().sensor)
    assert coverage.sweep == pytest.approx(angle + 0.1)
    assert np.cos(coverage.start_azimuth - heading - 0.4) == pytest.approx(1.0)
