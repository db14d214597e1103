# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A radar with a wider beam than its parameters tell is tracked as if they told it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.near_radars import crowd, PANEL
from benchmarks.real_data import preset
from benchmarks.wanderers import BIRD, DRONE
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

PERIOD, LOOKS, LEARNT, SHIPS, FARTHEST = 2.5, 120, 40, 12, 22e3  # [s], [m]
RANGE_SD = 25.0  # [m]
WIDE, AS_TOLD = np.radians(0.5), 0.00175  # azimuth noise of a ship's radar, and the default [rad]


def outcome(azimuth_sd, turn_rate=0.0, is_polar=True, **values):
    """Return the tracker, how many tracks were confirmed after it had learnt, NEES, false ones."""
    rng = np.random.default_rng(3)
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {'sensor.dimensions': 2, **values}))
    start, course = rng.uniform(-12e3, 12e3, (SHIPS, 2)), rng.uniform(-np.pi, np.pi, SHIPS)
    place, speed = start, rng.uniform(2.0, 12.0, SHIPS)
    new, known, nees, false = set(), set(), [], 0
    for look in range(LOOKS):
        course = course + turn_rate * PERIOD
        velocity = speed[:, None] * np.stack([np.cos(course), np.sin(course)], axis=1)
        place = place + velocity * PERIOD
        seen = place[rng.random(SHIPS) < 0.85]
        polar = np.stack([np.hypot(*seen.T), np.arctan2(*seen.T[::-1])], axis=1)
        polar += [RANGE_SD, azimuth_sd] * rng.normal(size=polar.shape)
        clutter = rng.uniform([500.0, -np.pi], [FARTHEST, np.pi], (5, 2))
        distance, azimuth = np.concatenate([polar, clutter]).T
        time = np.full(len(distance), PERIOD * look)
        plots = Plots.polar(time, distance, azimuth)
        if not is_polar:
            where = distance * np.stack([np.cos(azimuth), np.sin(azimuth)])
            plots = Plots.cartesian(time, where.T)
        tracks = tracker.track(replace(plots, stamp=PERIOD * look))
        ids = set(tracks.id[tracks.confirmed].tolist())
        new |= (ids - known) if look >= LEARNT else set()
        known |= ids
        if look >= LEARNT:
            mean, P = (part[tracks.confirmed] for part in tracks.planes[0].moments())
            off = mean[:, None, ::2] - place
            on = np.hypot(*np.moveaxis(off, -1, 0))
            near, row = on.min(axis=1) < 1000.0, np.arange(len(mean))
            off = off[row, on.argmin(axis=1)]
            P = np.linalg.inv(P[:, ::2, ::2])
            nees += (np.einsum('td,tde,te->t', off, P, off)[near] / 2.0).tolist()
            false += int((~near).sum())
    return tracker, len(new), float(np.mean(nees)), false / (LOOKS - LEARNT)


def test_wider_beam_than_told_is_learnt():
    """Were it not: NEES 8.2, and 0.09 false tracks at a time."""
    tracker, new, nees, false = outcome(WIDE)
    assert tracker.radar.raised[0] == 1.0
    assert tracker.radar.raised[1] * AS_TOLD == pytest.approx(WIDE, rel=0.25)
    assert new <= 1
    assert nees < 1.5
    assert false < 0.05


def test_what_is_learnt_of_noise_outlives_other_parameters_and_a_restart():
    """It is in the state; the parameters stay as they are told."""
    tracker, *_ = outcome(WIDE)
    tracker.reconfigure(with_values(tracker.config, {'sensor.detection_probability': 0.8}))
    assert tracker.radar.raised[1] > 3.0
    other = RadarTracker(tracker.config)
    other.restore(tracker.save())
    assert other.state.scatter.raised()[1] == tracker.state.scatter.raised()[1] > 3.0
    tracker.reset()
    assert tracker.radar.raised == (1.0, 1.0, 1.0)


def test_cartesian_plots_that_are_worse_than_told_are_learnt():
    """Both axes alike, since nobody knows how the sensor measures."""
    tracker, *_ = outcome(WIDE, is_polar=False)
    raised = tracker.radar.raised
    assert raised[0] == raised[1] > 1.5


@pytest.mark.parametrize('turn_rate', [0.0, 0.03])
def test_noise_as_told_is_left_as_told(turn_rate):
    """Also where all ships turn all the time."""
    tracker, *_ = outcome(AS_TOLD, turn_rate)
    assert tracker.radar.raised == (1.0, 1.0, 1.0)


def panel(told):
    """Return a tracker of a 3-D panel, and the share of drones and birds with a track, by look."""
    scene = crowd(10, radar=PANEL, looks=120, counts=((DRONE, 6), (BIRD, 6)), radius=150.0)
    own = {'sensor.azimuth_sd': told * 0.02, 'sensor.elevation_sd': told * 0.03}
    tracker, held = RadarTracker(preset('drone_radar', **own)), []
    for look, plots in enumerate(scene.messages):
        tracks = tracker.track(plots)
        there = [scene.truth.of_contact(k).at(np.array([plots.stamp])).position for k in range(12)]
        mean = tracks.planes[0].moments()[0][tracks.confirmed][:, ::2]
        off = np.linalg.norm(mean[:, None] - np.concatenate(there)[:, :2], axis=2)
        held += [(off < 150.0).any(axis=0).mean()] if look >= 80 else []
    return tracker, float(np.mean(held))


def test_noise_that_lets_no_track_come_to_be_is_learnt():
    """Angles told a tenth as noisy as they are: nothing was learnt, and held was 0.75."""
    tracker, held = panel(told=0.1)
    assert tracker.radar.raised[1:] == pytest.approx((10.0, 10.0), rel=0.3)
    assert held > 0.85
    assert panel(told=1.0)[0].radar.raised == (1.0, 1.0, 1.0)
