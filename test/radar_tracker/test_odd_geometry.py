# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts over the sensor and through it, and plots that are all the same, spoil no track."""

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import SensorConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Coverage, Plots
from tracking_core.config import with_values
from tracking_core.platform import pose_at

PERIOD, SCANS = 4.0, 60  # s; the contact is over the sensor in the middle
ROUNDING = 1e-12  # of a correlation


def assert_sound(tracks):
    """Covariances are symmetric and not negative, probabilities are probabilities."""
    for plane in tracks.planes:
        P = plane.covariance
        assert np.isfinite(plane.mean).all()
        np.testing.assert_array_equal(P, np.swapaxes(P, -1, -2))
        sd = np.sqrt(np.einsum('tjnn->tjn', P))
        assert (sd > 0.0).all()
        correlation = P / (sd[..., :, None] * sd[..., None, :])
        assert np.linalg.eigvalsh(correlation).min(initial=1.0) >= -ROUNDING
        assert ((plane.mode_probability >= 0.0) & (plane.mode_probability <= 1.0 + 1e-12)).all()
    existence = tracks.existence_probability
    assert ((existence >= 0.0) & (existence <= 1.0)).all()


def fly(offset, height, copies=1, **values):
    """Track a contact that flies past the sensor at an offset; return tracks and ids by scan."""
    rng, ids = np.random.default_rng(1), []
    config = with_values(RadarTrackerConfig(), {'scan.assembly': 'snapshot', **values})
    radar = RadarTracker(config)
    for scan in range(SCANS):
        time = PERIOD * scan
        x, y, z = 150.0 * (time - PERIOD * SCANS / 2), offset, height
        ground = np.hypot(x, y)
        distance = np.abs(np.hypot(ground, z) + rng.normal(0.0, 30.0))
        azimuth = np.arctan2(y, x) + rng.normal(0.0, 1e-3)
        columns = {'elevation': np.full(copies, np.arctan2(z, ground))} if height else {}
        plots = Plots.polar(*np.full((copies, 3), [time, distance, azimuth]).T, **columns)
        tracks = radar.track(plots)
        assert_sound(tracks)
        ids.append(set(tracks.id[tracks.confirmed].tolist()))
    return ids


@pytest.mark.parametrize('height', [0.0, 3000.0], ids=['through the origin', 'through the zenith'])
def test_contact_over_the_sensor_keeps_its_id(height):
    """Azimuth jumps by half a turn and means nothing there; range is all that is left."""
    dimensions = {'sensor.dimensions': 3} if height else {}
    ids = fly(0.0, height, **dimensions)
    assert ids[20] == ids[-1]
    assert len(ids[-1]) == 1


def test_plots_that_are_all_the_same_make_one_track():
    """Twenty copies of each plot: nothing divides by zero, nothing becomes certain."""
    ids = fly(5000.0, 0.0, copies=20)
    assert ids[-1]


@pytest.mark.parametrize('dimensions', [2, 3])
@pytest.mark.parametrize('place', [(10.0, 0.3, 0.1), (1e4, 0.7, 0.4), (3e3, 0.2, 1.56)])
def test_noise_expected_of_a_plot_is_that_of_one(place, dimensions):
    """Near by, far off and in the zenith: gates are as wide as the plots there are unsure."""
    config = SensorConfig(range_sd=50.0, azimuth_sd=0.1, elevation_sd=0.05)
    radar, where = Radar(config, dimensions, is_polar=True), Coverage(0.0, 0.0)
    time, distance, azimuth, elevation = np.array([[0.0, *place]]).T
    plots = Plots.polar(time, distance, azimuth, elevation=elevation)
    scan = radar.measure(plots, pose_at(None, time), where, volume=1.0)
    expected = radar.noise(scan.position, where)
    # The place of the plot is moved out by 1 % at most, where noise bends it in.
    np.testing.assert_allclose(expected, scan.covariance, rtol=0.02, atol=1.0)


def test_contact_of_a_coarse_radar_has_its_plots():
    """Azimuths good to 6 degrees: as many plots as the gate promises, to a percent."""
    values = {
        'scan.assembly': 'snapshot', 'sensor.range_sd': 5.0, 'sensor.azimuth_sd': 0.1,
        'motion.horizontal.acceleration_sd': (0.05, 0.5), 'clutter_density': 1e-9,
        'initiation.speed_max': 150.0,
    }  # fmt: skip
    radar, rng = RadarTracker(with_values(RadarTrackerConfig(), values)), np.random.default_rng(4)
    missed = []
    for look in range(1000):
        time = np.full(1, 2.5 * look)
        noisy = np.array([[1e4, 0.0]]) + rng.normal(0.0, [5.0, 0.1], (1, 2))
        tracks = radar.track(replace(Plots.polar(time, *noisy.T), stamp=2.5 * look))
        missed += (tracks.misses[tracks.confirmed] > 0).tolist()
    assert np.mean(missed) < 0.015
