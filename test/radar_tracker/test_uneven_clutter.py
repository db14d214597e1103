# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A shower of rain makes no tracks, and ships in it and beside it are held."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

TURN_TIME, FARTHEST, DETECTION = 2.5, 22e3, 0.85  # [s], [m]
SD = np.array([40.0, 0.009])  # [m], [rad]
LOOKS, SETTLED = 60, 20
SHIPS = np.array([[8000.0, 500.0], [-6000.0, 3000.0], [1000.0, -9000.0]])  # the first in the rain
VELOCITY = np.array([[-4.0, 5.0], [6.0, 0.0], [0.0, 8.0]])  # [m/s]


def polar(place):
    """Return range and azimuth of places (K, 2)."""
    return np.column_stack([np.hypot(*place.T), np.arctan2(place[:, 1], place[:, 0])])


def messages(rain: float, sectors: int):
    """Yield what a radar tells of the ships, of rain ahead and of some false plots everywhere."""
    rng = np.random.default_rng(1)
    for k in range(LOOKS):
        seen = (SHIPS + VELOCITY * TURN_TIME * k)[rng.random(len(SHIPS)) < DETECTION]
        shower = rng.uniform([6e3, -2e3], [10e3, 2e3], (rng.poisson(rain), 2))
        anywhere = rng.uniform([50.0, -np.pi], [FARTHEST, np.pi], (rng.poisson(5.0), 2))
        place = np.concatenate([polar(seen) + SD * rng.normal(size=seen.shape), polar(shower),
                                anywhere])  # fmt: skip
        azimuth = place[:, 1] % (2.0 * np.pi)
        time = TURN_TIME * (k + azimuth / (2.0 * np.pi))
        for sector in range(sectors):
            ours = (azimuth * sectors / (2.0 * np.pi)).astype(int) == sector
            plots = Plots.polar(time[ours], place[ours, 0], azimuth[ours])
            end = TURN_TIME * (k + (sector + 1) / sectors)
            yield replace(plots, stamp=end), SHIPS + VELOCITY * end


def outcome(rain: float, sectors: int = 1, **values) -> tuple[list[float], float, float]:
    """Return how long each ship was held, false tracks on the mean, the share of clutter there."""
    values = {
        'sensor.range_sd': SD[0], 'sensor.azimuth_sd': SD[1], 'sensor.range_min': 50.0,
        'sensor.range_max': FARTHEST, 'sensor.detection_probability': DETECTION,
        'initiation.speed_max': 40.0, 'motion.horizontal.acceleration_sd': (0.005, 0.2),
        'scan.period': TURN_TIME, **values,
    }  # fmt: skip
    tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    held, false = [], []
    for plots, ships in messages(rain, sectors):
        tracks = tracker.track(plots)
        mean = tracks.planes[0].average[tracks.confirmed][:, [0, 2]]
        near = np.hypot(*(mean[:, None] - ships).T) < 500.0
        held.append(near.any(axis=1))
        false.append(int((~near.any(axis=0)).sum()))
    settled = SETTLED * sectors
    report = tracker.state.report
    share = report.densest_clutter / report.clutter_density
    return np.mean(held[settled:], axis=0).tolist(), float(np.mean(false[settled:])), share


@pytest.mark.parametrize('sectors', [1, 8])
def test_rain_makes_no_tracks(sectors: int) -> None:
    """Were its plots spread over all that the radar sees, they would be as rare as ships."""
    held, false, share = outcome(30.0, sectors)
    assert min(held) > 0.95
    assert false < 0.3
    assert share > 5.0


def test_density_that_is_told_is_the_same_everywhere() -> None:
    """Who tells the density knows better, or has the tracks of the rain."""
    space = (FARTHEST - 50.0) * 2.0 * np.pi
    _, false, share = outcome(30.0, clutter_density=35.0 / space)
    assert false > 5.0
    assert share == 1.0


@pytest.mark.parametrize(('nearest', 'farthest'), [(0.0, 3.0), (3e6, 4e6)])
def test_map_has_room_for_any_radar(nearest: float, farthest: float) -> None:
    """A toy of three metres, and one that sees satellites only."""
    values = {'scan.assembly': 'snapshot', 'sensor.range_min': nearest,
              'sensor.range_max': farthest}  # fmt: skip
    tracker, rng = (
        RadarTracker(with_values(RadarTrackerConfig(), values)),
        np.random.default_rng(1),
    )
    for k in range(5):
        place = rng.uniform([nearest, -np.pi], [farthest, np.pi], (40, 2))
        tracks = tracker.track(replace(Plots.polar(np.full(40, 4.0 * k), *place.T), stamp=4.0 * k))
        assert np.isfinite(tracks.existence_probability).all()
    assert tracker.state.report.densest_clutter >= tracker.state.report.clutter_density > 0.0
