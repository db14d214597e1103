# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Radar plots that two contacts have in common: cells in range and azimuth, ids through them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from msg_adapters.tracks import kinematics
from radar_tracker.build import build_setup
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import SensorConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.association import JOINT
from tracking_core.batches import Coverage, Plots
from tracking_core.config import with_values
from tracking_core.unresolved.resolution import near_pairs, Places
from tracking_tools.scenarios import Contact, Leg, Legs, Scenario, SimulatedRadar
from tracking_tools.scenarios.plots import plots as simulated

CELL = {'sensor.range_resolution': 150.0, 'sensor.azimuth_resolution': 0.02}
HERE = Coverage(0.0, 0.0, sensor_position=(1_000.0, -2_000.0, 30.0))
ANGLE = np.radians(0.8)


def radar(d: int) -> Radar:
    """Return a radar with the cell."""
    return Radar(SensorConfig(range_resolution=150.0, azimuth_resolution=0.02), d, True)


@pytest.mark.parametrize('d', [2, 3])
def test_reach_holds_all_that_is_nearer_than_the_limit(d: int) -> None:
    """Contacts anywhere in the cell, about a sensor that is not in the origin, are in the box."""
    rng = np.random.default_rng(4)
    place = rng.uniform(-40e3, 40e3, (20_000, 3)) * [1.0, 1.0, 0.1]
    other = place + rng.normal(0.0, 400.0, place.shape)
    place, other, sensor = place[:, :d], other[:, :d], radar(d)
    inside = (np.abs(sensor.separation(place, other, HERE)) < 1.0).all(axis=1)
    assert inside.sum() > 100
    assert (np.abs(other - place) <= sensor.reach(place, HERE))[inside].all()


def test_separation_is_in_cells() -> None:
    """Half a cell farther and a whole cell to the right, across the wrap of azimuth."""
    origin = np.array(HERE.sensor_position[:2])
    polar = np.array([[20e3, -3.135], [20_075.0, 3.135 - 0.02 + 2.0 * (np.pi - 3.135)]])
    at = polar[:, :1] * np.stack([np.cos(polar[:, 1]), np.sin(polar[:, 1])], axis=1) + origin
    assert_allclose(radar(2).separation(at[:1], at[1:], HERE), [[0.5, -1.0]], atol=1e-9)


def test_unknown_height_keeps_nobody_apart() -> None:
    """A plot without elevation is compared at the height of the contact."""
    place = np.array([[20e3, 0.0, 3e3]])
    plot = np.array([[20e3, 0.0, np.nan]])
    assert_allclose(radar(3).separation(place, plot, HERE), 0.0, atol=1e-9)


def test_one_resolution_alone_and_hard_association_are_refused() -> None:
    """Both or neither, and tracks weighed jointly only."""
    for name, value in CELL.items():
        with pytest.raises(ValueError, match='must both be 0 or both be above 0'):
            with_values(RadarTrackerConfig(), {name: value})
    with pytest.raises(ValueError, match='association must be jpda'):
        with_values(RadarTrackerConfig(), {**CELL, 'association': 'nearest'})
    for joint in JOINT:
        with_values(RadarTrackerConfig(), {**CELL, 'association': joint})


def test_default_resolves_everything() -> None:
    """Off unless a cell is given."""
    assert build_setup(RadarTrackerConfig(), radar(2)).resolution is None


def crossing(seed: int, angle: float = ANGLE) -> Scenario:
    """Two aircraft whose paths cross at 1.6 degrees: nearer than 150 m for 13 turns."""
    contacts = tuple(
        Contact(k + 1, Legs((-24e3, 30e3 - side * 24e3 * np.sin(angle), 0.0), speed=200.0,
                            course=side * angle, legs=(Leg(400.0),)))
        for k, side in enumerate((1.0, -1.0))
    )  # fmt: skip
    return Scenario(
        SimulatedRadar(
            period=4.0, range_sd=30.0, azimuth_sd=0.00175, clutter_per_turn=10.0,
            range_limits=(1_000.0, 60_000.0), range_resolution=150.0, azimuth_resolution=0.02,
        ),
        contacts, 240.0, 'two aircraft that cross', seed=seed,
    )  # fmt: skip


def kept(seed: int, **values) -> bool:
    """Return whether both aircraft have after the crossing the ids that they had before it."""
    config = with_values(RadarTrackerConfig(), {
        'sensor.range_sd': 30.0, 'sensor.azimuth_sd': 0.00175, 'initiation.speed_max': 350.0,
        'motion.horizontal.acceleration_sd': [0.2, 2.0], **values,
    })  # fmt: skip
    tracker, ids = RadarTracker(config), []
    for scan in simulated(crossing(seed), np.random.default_rng(seed)):
        c = scan.columns
        plots = Plots.polar(c['time'], c['range'], c['azimuth'], snr=c['snr'])
        tracks = tracker.track(replace(plots, stamp=scan.start))
        where = kinematics(tracks, 'mmse')[0][:, :2]
        off = np.linalg.norm(where[:, None] - scan.truth.position[:, :2], axis=2)
        off[~tracks.confirmed] = np.inf
        good = len(off) and (off.min(axis=0) < 600.0).all()
        ids.append(tuple(tracks.id[off.argmin(axis=0)]) if good else ())
    before, after = ids[12], ids[-1]
    return len(set(before)) == 2 and before == after


def share_kept(runs: int, **values) -> float:
    """Return in how many of the runs both keep their ids."""
    return float(np.mean([kept(seed, **values) for seed in range(runs)]))


@pytest.mark.slow
def test_ids_are_kept_through_a_cell_with_the_rule_only() -> None:
    """Eight runs each: both ids come out as they went in; without the rule never."""
    assert share_kept(8, **CELL) == 1.0
    assert share_kept(8) == 0.0


def test_chance_of_one_cell_is_that_of_samples() -> None:
    """Vague contacts near each other in 2-D: the Gaussian in range and azimuth is nearly exact."""
    rng, rule = np.random.default_rng(2), build_setup(
        with_values(RadarTrackerConfig(), CELL), radar(2)
    ).resolution  # fmt: skip
    mean = np.array([[20e3, 10e3], [20_090.0, 10_150.0]])
    P = np.array([[[900.0, 300.0], [300.0, 2_500.0]], [[1_600.0, -200.0], [-200.0, 400.0]]])
    *_, chance = near_pairs(Places(mean, P, np.zeros((2, 2))), HERE, rule)
    one, other = (rng.multivariate_normal(mean[k], P[k], 200_000) for k in (0, 1))
    limit = 1.0 + rule.softness * rng.normal(size=(200_000, 2))
    inside = (np.abs(radar(2).separation(one, other, HERE)) < limit).all(axis=1)
    assert 0.1 < inside.mean() < 0.9
    assert chance[0] == pytest.approx(inside.mean(), abs=0.02)


@pytest.mark.parametrize('d', [2, 3])
def test_range_rates_are_used_beside_the_rule(d: int) -> None:
    """Two within the limit and one elsewhere: radial speeds as good as one look measures them."""
    rng = np.random.default_rng(5)
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {
        **CELL, 'sensor.range_sd': 30.0, 'sensor.range_rate_sd': 1.0, 'scan.assembly': 'snapshot',
    }))  # fmt: skip
    azimuth, speed = np.array([0.3, 0.315, 2.0]), np.array([100.0, 102.0, 90.0])
    height = np.full(3, 0.05 if d == 3 else np.nan)
    worst = []
    for k in range(20):
        away = np.array([20e3, 20_100.0, 20e3]) + 4.0 * k * speed + rng.normal(0.0, 30.0, 3)
        rate = speed + rng.normal(0.0, 1.0, 3)
        plots = Plots.polar(
            np.full(3, 4.0 * k), away, azimuth, elevation=height, range_rate=rate
        )  # fmt: skip
        tracks = tracker.track(replace(plots, stamp=4.0 * k))
        mean = tracks.planes[0].estimate('mmse')[0]
        radial = (mean[:, 0] * mean[:, 1] + mean[:, 2] * mean[:, 3]) / np.hypot(
            mean[:, 0], mean[:, 2]
        )
        worst.append(np.abs(np.sort(radial) - np.sort(speed)).max() if len(radial) == 3 else 99.0)
    assert tracks.confirmed.sum() == 3
    assert max(worst[5:]) < 4.0  # sd of a look 1, and the neighbour's rate is 2 off
