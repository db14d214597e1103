# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A radar that sees near has tracks with defaults that are for one which sees far."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.plausible import fastest
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Coverage, Plots
from tracking_core.config import with_values
from tracking_core.lifecycle_config import InitiationConfig

PEOPLE = 4
QUICK = {'farthest': 30.0, 'period': 0.1, 'sd': (0.15, 0.01), 'false': 2.0, 'speed': 1.0}
HARBOUR = {'farthest': 200.0, 'period': 1.0, 'sd': (2.0, 0.01), 'false': 10.0, 'speed': 2.0}


def watch(farthest, period, sd, false, speed, is_polar=True, range_sd=None, looks=60):
    """Return the tracker with defaults, and how many of four contacts have a track at the end."""
    rng, azimuth = np.random.default_rng(5), np.array([-0.8, -0.3, 0.3, 0.8])
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'sensor.dimensions': 2}))
    distance = np.array([0.3, 0.5, 0.7, 0.9]) * farthest
    start = distance[:, None] * np.column_stack([np.cos(azimuth), np.sin(azimuth)])
    velocity = rng.uniform(-speed, speed, (PEOPLE, 2))
    for look in range(looks):
        place = start + velocity * period * look
        polar = np.column_stack([np.hypot(*place.T), np.arctan2(*place.T[::-1])])
        polar += np.array(sd) * rng.standard_normal(polar.shape)
        polar = polar[rng.random(PEOPLE) < 0.9]
        clutter = rng.uniform([0.1 * farthest, -1.0], [farthest, 1.0], (rng.poisson(false), 2))
        reach, angle = np.concatenate([polar, clutter]).T
        time = np.full(len(reach), period * look)
        plots = Plots.polar(time, reach, angle)
        if not is_polar:
            where = reach * np.stack([np.cos(angle), np.sin(angle)])
            plots = Plots.cartesian(time, where.T)
        if range_sd is not None:
            plots = replace(plots, range_sd=np.full(len(time), range_sd))
        tracks = tracker.track(replace(plots, stamp=period * look))
    mean, _ = tracks.planes[0].moments()
    off = np.linalg.norm(mean[tracks.confirmed][:, None, ::2] - place, axis=2)
    return tracker, int((off < 0.07 * farthest).any(axis=0).sum())


@pytest.mark.parametrize('is_polar', [True, False])
@pytest.mark.parametrize('farthest', [30.0, 100.0])
def test_people_before_a_radar_with_defaults_have_tracks(farthest, is_polar):
    """Its plots cannot be as unsure as it sees far; believed, no pair was worth a track."""
    tracker, held = watch(**{**QUICK, 'farthest': farthest}, is_polar=is_polar)
    assert held == PEOPLE
    noise = tracker.plot_noise(np.array([[farthest, 0.0, 0.0]]))
    assert noise[0, 0, 0] <= (0.03 * farthest) ** 2


def test_boats_in_a_small_harbour_have_tracks():
    """At 600 m/s they would be seen once; no pair that this allows is worth a track."""
    tracker, held = watch(**HARBOUR, looks=100)
    assert held >= 3
    assert tracker.core.setup.initiation.speed_max == pytest.approx(200.0 / 3.0, rel=0.05)


def test_noise_that_a_radar_can_have_is_used_as_told():
    """By the parameter, if the radar sees farther, and by plots at any distance."""
    tracker, _ = watch(**{**QUICK, 'farthest': 2000.0})
    assert tracker.plot_noise(np.array([[100.0, 0.0, 0.0]]))[0, 0, 0] == pytest.approx(50.0**2)
    assert watch(**QUICK, range_sd=40.0)[1] == 0


def test_speeds_are_as_told_where_a_contact_stays_for_some_looks():
    """Nor is anything taken for known in the first looks, or by a sensor that saw nothing."""
    turns, told = np.full(11, 4.0), InitiationConfig()

    def limit(farthest, steps=turns):
        return fastest(told, farthest, steps, Coverage(40.0, 44.0))

    assert limit(50e3) == limit(300.0, turns[:5]) == limit(300.0, turns[:0]) == 600.0
    assert limit(0.0) == 600.0
    assert limit(300.0) == pytest.approx(25.0)
    assert limit(1e-3, np.full(11, 1e9)) > 0.0
