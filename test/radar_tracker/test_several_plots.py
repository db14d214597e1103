# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ships of which each look gives several plots along the hull: a track each, and ids that stay."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.association import JOINT
from tracking_core.batches import Floats, Plots, Tracks
from tracking_core.config import with_values

PERIOD, LENGTH, SPEED = 2.5, 220.0, 7.0  # [s], [m], [m/s]
SHIPS = {
    'scan.period': PERIOD, 'sensor.range_sd': 40.0, 'sensor.azimuth_sd': 0.009,
    'sensor.range_max': 12e3, 'sensor.detection_probability': 0.85, 'initiation.speed_max': 40.0,
    'motion.horizontal.acceleration_sd': [0.005, 0.2],
    'motion.horizontal.sojourn_time': [1200.0, 60.0], 'existence.lifetime': 7200.0,
}  # fmt: skip
LONG = {'sensor.contact_size': 250.0}


def turn(ships: Floats, k: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Return azimuth and range of the plots of a turn: four places on each hull, and false."""
    start, velocity = ships[:, :2], ships[:, 2:]
    bow = velocity / np.hypot(*velocity.T)[:, None]
    along = LENGTH * np.linspace(-0.5, 0.5, 4)
    azimuth = np.arctan2(start[:, 1], start[:, 0]) % (2.0 * np.pi)
    here = start + velocity * (PERIOD * (k + azimuth / (2.0 * np.pi)))[:, None]
    place = (here[:, None] + along[:, None] * bow[:, None]).reshape(-1, 2)
    place = place[rng.random(len(place)) < 0.7]
    false = rng.poisson(10)
    distance = np.hypot(*place.T) + rng.normal(0.0, 8.0, len(place))
    angle = np.arctan2(place[:, 1], place[:, 0]) + rng.normal(0.0, 0.003, len(place))
    distance = np.concatenate([distance, rng.uniform(500.0, 12e3, false)])
    angle = np.concatenate([angle, rng.uniform(0.0, 2.0 * np.pi, false)]) % (2.0 * np.pi)
    order = angle.argsort()
    return angle[order], distance[order]


def ids_of(
    ships: Floats, turns: int, sectors: int = 1, seed: int = 3, **values
) -> list[list[list[int]]]:
    """Return the ids of the confirmed tracks at each ship, turn by turn."""
    rng, ids = np.random.default_rng(seed), []
    values['scan.assembly'] = 'message' if sectors == 1 else 'sector'
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**SHIPS, **values}))
    for k in range(turns):
        angle, distance = turn(ships, k, rng)
        part = angle / (2.0 * np.pi)
        for first, last in pairwise(np.arange(sectors + 1) / sectors):
            rows = (part >= first) & (part < last)
            plots = Plots.polar(PERIOD * (k + part[rows]), distance[rows], angle[rows])
            tracks = tracker.track(replace(plots, stamp=PERIOD * (k + first)))
        ids.append([near(tracks, ship[:2] + PERIOD * (k + 0.5) * ship[2:]) for ship in ships])
    return ids


def near(tracks: Tracks, place: Floats) -> list[int]:
    """Return the ids of confirmed tracks within a ship's length of a place."""
    mean = tracks.planes[0].estimate('mmse')[0][:, [0, 2]]
    return list(tracks.id[tracks.confirmed & (np.hypot(*(mean - place).T) < LENGTH)])


@pytest.mark.parametrize('sectors', [1, 8])
def test_long_ship_is_one_track(sectors: int) -> None:
    """Also on the seam of two messages, where half of it waits; without the size it is several."""
    ships = np.array([[-2000.0, 3500.0, 5.0, 5.0], [0.0, 4000.0, SPEED, 0.0]])
    for ids in ids_of(ships, 60, sectors, **LONG)[10:]:
        assert [len(one) for one in ids] == [1, 1]
    assert max(len(one) for one in ids_of(ships, 60, sectors)[-1]) > 1


def test_ships_that_pass_each_other_keep_their_ids() -> None:
    """Hulls of 220 m, 120 m apart, one plot or two for ten turns: most ids come out as before."""
    ships = np.array([[-500.0, 3000.0, SPEED, 0.0], [540.0, 3120.0, -SPEED, 0.0]])
    runs = [ids_of(ships, 80, seed=seed, **LONG) for seed in range(8)]
    assert all([len(one) for one in ids[-1]] == [1, 1] for ids in runs)
    assert sum(ids[12] == ids[-1] for ids in runs) >= 6


def test_hard_association_is_refused_with_a_size() -> None:
    """Tracks that have a plot in common are weighed jointly only."""
    with pytest.raises(ValueError, match=r'jpda or jpda_star where sensor\.contact_size'):
        with_values(RadarTrackerConfig(), {**LONG, 'association': 'nearest'})
    for joint in JOINT:
        with_values(RadarTrackerConfig(), {**LONG, 'association': joint})
