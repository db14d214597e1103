# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the gate of a track lets in, what is told of it, and when it is too large to be one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.chances import chi_square_bound
from tracking_core.config import with_values

PERIOD, SD = 4.0, 50.0  # [s], [m]
VALUES = {
    'scan.assembly': 'snapshot',
    'sensor.position_sd': SD,
    'sensor.detection_probability': 0.95,
    'clutter_density': 1e-10,
    'motion.horizontal.acceleration_sd': [0.1],
    'motion.horizontal.sojourn_time': [60.0],
    'motion.horizontal.turn_rate': [0.0],
}
PLACES = np.array([[30e3, 0.0], [0.0, 30e3], [-30e3, 0.0], [0.0, -30e3]])
AT_REST = PLACES[:2]


def scan(number: int, places=(), **columns) -> Plots:
    """Return plots at these places (M, 2)."""
    places = np.asarray(places, float).reshape(-1, 2)
    plots = Plots.cartesian(np.full(len(places), PERIOD * number), places, **columns)
    return replace(plots, stamp=PERIOD * number)


def settled(looks: int = 20, places=AT_REST, **values) -> RadarTracker:
    """Return a tracker that has followed contacts at rest."""
    named = {name.replace('__', '.'): value for name, value in values.items()}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**VALUES, **named}))
    for number in range(looks):
        tracker.track(scan(number, places))
    return tracker


@pytest.mark.parametrize('is_crowded', [True, False])
def test_track_whose_gate_is_crowded_follows_nobody(is_crowded: bool) -> None:
    """Its contact has gone: it ends once ten strange plots are expected, else as configured."""
    density = 1e-5 if is_crowded else 1e-11
    tracker = settled(lifecycle='m_of_n', m_of_n__drop_misses=40)
    tracker.reconfigure(with_values(tracker.config, {'clutter_density': density}))
    misses, expected = [], []
    for number in range(20, 70):
        tracks = tracker.track(scan(number))
        misses.append(tracks.misses.max(initial=0))
        expected.append(tracks.gate_volume.max(initial=0.0) * density)
    if is_crowded:
        assert 8.0 < max(expected) < 10.0
    else:
        assert max(misses) == 39


@pytest.mark.parametrize('other_tells', [True, False])
def test_gate_is_that_of_the_components_a_plot_has(other_tells: bool) -> None:
    """A plot of two components is judged as such, whether or not another has a range rate too."""
    two, three = (chi_square_bound(0.997, count) for count in (2, 3))
    for squared, missed in ((0.5 * (two + three), 1), (0.9 * two, 0)):
        tracker = settled()
        sigma = tracker.tracks.gate_size / 3.0  # (T, 2), of the next gate as well by now
        rates = np.array([np.nan, 0.0 if other_tells else np.nan])
        places = AT_REST + np.sqrt([[0.5 * squared], [0.0]]) * sigma
        tracks = tracker.track(scan(20, places, range_rate=rates))
        assert tracks.misses.tolist() == [missed, 0]


def test_nis_is_that_of_the_last_plot() -> None:
    """Two on average for plots of two components, NaN in a look without one."""
    tracker, rng, seen = settled(places=PLACES), np.random.default_rng(1), []
    for number in range(20, 320):
        noise = rng.normal(0.0, SD, PLACES.shape)
        seen.append(tracker.track(scan(number, PLACES + noise)).nis)
    assert np.nanmean(seen) == pytest.approx(2.0, rel=0.1)
    assert np.isnan(seen).mean() < 0.01  # those beyond the gate
    assert np.isnan(tracker.track(scan(320)).nis).all()


@pytest.mark.parametrize('density', [1e-10, 1e-6])
def test_nis_is_how_far_off_the_plot_is_however_doubtful(density: float) -> None:
    """A plot at twice the sigma of its gate has 4, in clutter as in a clear sky."""
    tracker = settled()
    tracker.reconfigure(
        with_values(
            tracker.config, {'clutter_density': density, 'sensor.detection_probability': 0.7}
        )
    )
    sigma = tracker.tracks.gate_size / 3.0
    off = np.array([[2.0, 0.0], [0.0, 0.0]]) * sigma
    tracks = tracker.track(scan(20, AT_REST + off))
    assert_allclose(tracks.nis, [4.0, 0.0], rtol=0.03, atol=1e-3)
