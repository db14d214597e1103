# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A 3-D radar on an aircraft that flies over its contacts and rolls."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.linalg import TURN, wrap_angle
from tracking_core.platform import Platform

PERIOD, SPEED, HEIGHT, TURNS = 2.0, 60.0, 800.0, 40  # [s], [m/s], [m]
BOATS = np.array([
    [600.0, 1200.0, 0.0], [1500.0, -900.0, 0.0], [2500.0, 1100.0, 0.0], [3500.0, -1500.0, 0.0],
    [4500.0, 900.0, 0.0], [5500.0, -2500.0, 0.0],
])  # fmt: skip
SD = np.array([10.0, 0.005, 0.005])  # of range [m], azimuth, elevation [rad]
VALUES = {
    'sensor.range_sd': SD[0], 'sensor.azimuth_sd': SD[1], 'sensor.elevation_sd': SD[2],
    'sensor.dimensions': 3, 'sensor.range_max': 8e3, 'initiation.speed_max': 40.0,
    'motion.horizontal.acceleration_sd': [0.1, 1.0], 'motion.vertical.acceleration_sd': [0.1, 1.0],
}  # fmt: skip


def pose(time, roll):
    """Return place (K, 3) and attitude at times (K,): straight on, rolling by so much [rad]."""
    nothing = np.zeros(len(time))
    place = np.stack([SPEED * time, nothing, nothing + HEIGHT], axis=1)
    angle = np.stack([nothing, nothing, roll * np.sin(TURN * time / 6.0)], axis=1)
    return place, Rotation.from_euler('ZYX', angle)


def seen(time, roll):
    """Return range, azimuth and elevation (6, 3) of the boats, each at its time."""
    place, attitude = pose(time, roll)
    x, y, z = attitude.inv().apply(BOATS - place).T
    distance = np.hypot(x, y)
    return np.stack([np.hypot(distance, z), np.arctan2(y, x), np.arctan2(z, distance)], axis=1)


def aircraft(roll):
    """Return its path at 20 Hz."""
    time = np.arange(0.0, PERIOD * TURNS + 0.1, 0.05)
    place, attitude = pose(time, roll)
    velocity = np.tile([SPEED, 0.0, 0.0], (len(time), 1))
    doubt = np.zeros((len(time), 3, 3)), np.zeros(len(time))
    return Platform(time, place, attitude.as_quat(), velocity, *doubt)


@pytest.mark.parametrize('roll', [0.0, np.radians(8.0)], ids=['level', 'rolling'])
def test_boats_below_are_found_in_every_turn(roll):
    """
    The aircraft is 120 m farther on at the end of a turn, which is 7 degrees of what is 1 km away.

    At 45 degrees below it a roll by 8 degrees turns azimuths by as much.
    """
    rng, path = np.random.default_rng(1), aircraft(roll)
    radar = RadarTracker(with_values(RadarTrackerConfig(), VALUES))
    for turn in range(TURNS):
        time = np.full(len(BOATS), PERIOD * turn)
        for _ in range(20):  # where it points depends on when
            azimuth = seen(time, roll)[:, 1]
            time = PERIOD * (turn + wrap_angle(-azimuth) % TURN / TURN)  # clockwise from ahead
        polar = seen(time, roll) + SD * rng.standard_normal((len(BOATS), 3))
        plots = Plots.polar(time, polar[:, 0], polar[:, 1], elevation=polar[:, 2])
        tracks = radar.track(replace(plots, stamp=PERIOD * turn), path)
    assert sorted(tracks.id[tracks.confirmed].tolist()) == [1, 2, 3, 4, 5, 6]
    assert (tracks.hits > TURNS - 4).all()
