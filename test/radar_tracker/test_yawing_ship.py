# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A radar on a ship that yaws in the sea: its antenna does not turn evenly over the ground."""

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.mounting import coverage_of
from radar_tracker.sweep import Sweep
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import NO_SWING, Plots
from tracking_core.config import with_values
from tracking_core.linalg import TURN, wrap_angle
from tracking_core.platform import Platform

PERIOD, TURNS = 2.5, 60  # of the antenna [s]
BUOYS = np.array([
    [2e3, 1e3], [-3e3, 4e3], [500.0, -7e3], [6e3, -1e3], [-8e3, -3e3], [3e3, 8e3],
])  # fmt: skip
VALUES = {
    'sensor.range_sd': 20.0, 'sensor.azimuth_sd': 0.005, 'sensor.range_max': 12e3,
    'motion.horizontal.acceleration_sd': [0.01, 0.2],
}  # fmt: skip


def heading(time):
    """Return that of a ship which yaws by 3 degrees to either side in six seconds."""
    return 0.7 + np.radians(3.0) * np.sin(TURN * time / 6.0)


def ship(until):
    """Return its path at 20 Hz."""
    time = np.arange(0.0, until + 0.05, 0.05)
    half, none = 0.5 * heading(time), 0.0 * time
    turn = np.stack([none, none, np.sin(half), np.cos(half)], axis=1)
    still = np.zeros((len(time), 3))
    return Platform(time, still, turn, still, np.zeros((len(time), 3, 3)), none)


@pytest.mark.parametrize('way', [1.0, -1.0], ids=['anticlockwise', 'clockwise'])
def test_contact_is_found_in_every_turn_of_a_ship_that_yaws(way):
    """The antenna is up to 4 degrees from an even turn, which is twice as far as the gates go."""
    rng, rate = np.random.default_rng(1), way * TURN / PERIOD
    radar = RadarTracker(with_values(RadarTrackerConfig(), VALUES))
    bearing, distance = np.arctan2(BUOYS[:, 1], BUOYS[:, 0]), np.hypot(*BUOYS.T)
    for turn in range(TURNS):
        time = np.full(len(BUOYS), PERIOD * turn)
        for _ in range(10):  # where it points depends on when
            on = wrap_angle(bearing - heading(time) - rate * time) / rate % PERIOD
            time = PERIOD * turn + (time + on) % PERIOD
        noise = rng.standard_normal((2, len(BUOYS)))
        plots = Plots.polar(
            time, distance + 20.0 * noise[0], bearing - heading(time) + 0.005 * noise[1]
        )
        tracks = radar.track(replace(plots, stamp=PERIOD * turn), ship(PERIOD * (turn + 1)))
    assert tracks.id[tracks.confirmed].tolist() == [1, 2, 3, 4, 5, 6]
    assert (tracks.hits > TURNS - 3).all()


def test_antenna_swings_with_its_ship():
    """Oracle: heading and mount at moments of the sweep; sectors are short, and swing not."""
    sensor = with_values(RadarTrackerConfig(), {'sensor.mount.yaw': 2.0}).sensor
    sweep = Sweep(1.0, 3.5, start_azimuth=0.4, angle=-TURN)
    coverage = coverage_of(sweep, ship(4.0).at(sweep.moments), sensor)
    times = np.linspace(1.0, 3.5, 40)
    expected = 0.4 - TURN * (times - 1.0) / 2.5 + heading(times) + 2.0
    np.testing.assert_allclose(coverage.azimuth_at(times), expected, atol=1e-3)
    sector = Sweep(1.0, 1.08, start_azimuth=0.4, angle=-0.2)
    assert coverage_of(sector, ship(4.0).at(sector.moments), sensor).swing == NO_SWING
