# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A 3-D radar whose plots lack their height now and then, as with secondary radar."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Coverage, Floats, Plots
from tracking_core.config import with_values
from tracking_core.platform import pose_at

HEIGHT, SPEED, INTERVAL = 8_000.0, 150.0, 4.0  # [m], [m/s], [s]
SITE = {
    'scan.assembly': 'snapshot', 'sensor.dimensions': 3, 'sensor.range_max': 60e3,
    'motion.horizontal.acceleration_sd': [0.5, 5.0],
    'motion.vertical.acceleration_sd': [0.3, 1.5], 'initiation.speed_max': 350.0,
}  # fmt: skip


def where(look: int) -> Floats:
    """Return where the aircraft is: it flies by at 12 km."""
    return np.array([12_000.0, SPEED * INTERVAL * (look - 30), HEIGHT])


def seen(place: Floats, look: int, rng: np.random.Generator, tells: bool, **columns) -> Plots:
    """Return its only plot, exact but for the noise of the parameters."""
    ground = np.hypot(place[0], place[1])
    r = np.hypot(ground, place[2]) + rng.normal(0.0, 50.0)
    azimuth = np.arctan2(place[1], place[0]) + rng.normal(0.0, 0.00175)
    elevation = np.arctan2(place[2], ground) + rng.normal(0.0, 0.0026) if tells else np.nan
    at = np.full(1, INTERVAL * look)
    plots = Plots.polar(at, np.full(1, r), np.full(1, azimuth), elevation=np.full(1, elevation),
                        **columns)  # fmt: skip
    return replace(plots, stamp=INTERVAL * look)


@pytest.mark.parametrize('range_rate', [False, True], ids=['places', 'range rates'])
def test_plots_without_height_lie_at_the_height_of_the_track(range_rate: bool) -> None:
    """As far out as the slant range they would be up to 2.4 km off; so would be range rates."""
    rng, off = np.random.default_rng(1), []
    tracker = RadarTracker(with_values(RadarTrackerConfig(), SITE))
    for look in range(60):
        place = where(look)
        closing = SPEED * place[1] / np.linalg.norm(place) + rng.normal(0.0, 2.0)
        columns = {'range_rate': np.full(1, closing)} if range_rate else {}
        tracks = tracker.track(seen(place, look, rng, look < 4 or look % 3 == 0, **columns))
        if look > 6:
            assert len(tracks) == 1
            assert tracks.id[0] == 1
            assert tracks.misses[0] == 0
            mean, covariance = tracks.planes[0].estimate('mmse')
            error = mean[0, [0, 2]] - place[:2]
            off.append(error @ np.linalg.solve(covariance[0][::2, ::2], error))
    assert np.mean(off) < 2.5  # of two components


def test_plot_without_height_proves_no_more_than_one_with() -> None:
    """It may be any of the false plots over its place; far and low, range is ground range."""
    chances = []
    for tells in (True, False):
        rng = np.random.default_rng(3)
        site = {**SITE, 'clutter_density': 3e-3}
        tracker = RadarTracker(with_values(RadarTrackerConfig(), site))
        for look in range(3):
            place = np.array([50_000.0, SPEED * INTERVAL * look, 500.0])
            tracks = tracker.track(seen(place, look, rng, tells or look < 2))
        chances.append(float(tracks.existence_probability[0]))
    with_height, without = chances
    assert 0.5 < without < with_height


@pytest.mark.parametrize('polar', [True, False])
def test_plot_space_over_a_place_is_that_of_all_its_elevations(polar: bool) -> None:
    """False plots without height are counted per square metre: by what lies above one."""
    radar = RadarTracker(with_values(RadarTrackerConfig(), SITE)).radar
    radar = replace(radar, is_polar=polar)
    span, r = radar.config.elevation_span, 20_000.0
    places = np.array([[r, 0.0, 0.0], [r, 0.0, np.nan]])
    columns = (np.full(2, r), np.zeros(2))
    plots = Plots.polar(np.zeros(2), *columns, elevation=places[:, 2])
    if not polar:
        plots = Plots.cartesian(np.zeros(2), places)
    scan = radar.measure(plots, pose_at(None, plots.time), Coverage(0.0, 1.0), 1.0)
    assert_allclose(scan.clutter_volume[1], scan.clutter_volume[0] * r * span)
