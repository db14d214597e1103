# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Cars that come and go faster than their Doppler can tell: range rates that come again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

INTERVAL = 40.0  # [m/s], from -20 to 20
SPEED = np.array([-29.0, -22.0, 3.0, 27.0])  # [m/s]
CARS = {
    'scan.assembly': 'snapshot', 'sensor.range_sd': 0.5, 'sensor.azimuth_sd': 0.015,
    'sensor.range_rate_sd': 0.3, 'sensor.range_max': 200.0, 'sensor.sector_width': 2.1,
    'initiation.speed_max': 50.0, 'existence.new_contacts': 3600.0, 'existence.lifetime': 10.0,
    'motion.horizontal.acceleration_sd': [4.0, 15.0],
}  # fmt: skip


def held(seed: int, **values) -> float:
    """Return the part of 40 looks, 15 a second, in which each car has a confirmed track."""
    rng, count = np.random.default_rng(seed), []
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**CARS, **values}))
    for k in range(40):
        x, y = 100.0 + SPEED * k / 15.0, np.array([-6.0, -3.0, 0.0, 3.0])
        distance = np.hypot(x, y)
        rate = SPEED * x / distance + rng.normal(0.0, 0.1, 4)
        plots = Plots.polar(
            np.full(4, k / 15.0), distance + rng.normal(0.0, 0.2, 4),
            np.arctan2(y, x) + rng.normal(0.0, 0.008, 4),
            range_rate=(rate + 0.5 * INTERVAL) % INTERVAL - 0.5 * INTERVAL,
        )  # fmt: skip
        tracks = tracker.track(replace(plots, stamp=k / 15.0))
        mean = tracks.planes[0].estimate('mmse')[0][tracks.confirmed]
        off = np.abs(mean[:, 0, None] - x) + np.abs(mean[:, 1, None] - SPEED)
        count.append((off < 5.0).any(axis=0).mean())
    return float(np.mean(count[10:]))


def test_cars_beyond_the_interval_are_followed_with_their_speeds() -> None:
    """All four; without the parameter only the one whose range rate is what it seems."""
    assert (
        np.mean([held(seed, **{'sensor.range_rate_interval': INTERVAL}) for seed in range(4)])
        > 0.97
    )
    assert np.mean([held(seed) for seed in range(4)]) < 0.5
