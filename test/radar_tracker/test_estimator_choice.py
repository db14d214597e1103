# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Every estimator of the menu in the radar tracker, by its parameter."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import numpy as np
from numpy.testing import assert_allclose
import pytest

from benchmarks.real_data import judge, preset, run
from benchmarks.recordings import air_scene, data_folder
from msg_adapters.tracks import kinematics, track_columns
from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.estimators import AdaptiveAlphaBeta, ESTIMATORS, FuzzyAlphaBeta, ImmAlphaBeta
from tracking_tools.scenarios import build

TEN_MINUTES = 60  # turns
PERIOD = 4.0
every_estimator = pytest.mark.parametrize('name', ESTIMATORS)


@every_estimator
def test_choice_is_built(name: str) -> None:
    """An estimator of the menu that nobody builds is not silently another one."""
    (plane, *_) = build_planes(RadarTrackerConfig(estimator=name), 3)
    assert type(plane.estimator) is ESTIMATORS[name]


@every_estimator
def test_estimator_holds_real_aircraft(name: str) -> None:
    """The first 10 minutes of the en-route scene: held 90 % of the time at least, no ghosts."""
    if not data_folder().is_dir():
        pytest.skip('the shared recordings are not beside the project')
    recording = air_scene(data_folder()).part(0, TEN_MINUTES)
    rows, _ = run(recording, preset(recording.preset, estimator=name))
    result = judge(recording, rows)
    assert result.continuity.held >= 0.9
    assert result.continuity.ghosts == 0


def climbing(turn: int, rng: np.random.Generator, range_rate: bool) -> Plots:
    """Two aircraft at 150 m/s, one climbs; clutter; another plot lacks elevation each turn."""
    time = PERIOD * turn
    x = np.array([-20_000.0, -15_000.0]) + 150.0 * time
    y, z = np.array([15_000.0, 25_000.0]), np.array([600.0, 300.0 + 10.0 * time])
    ground = np.hypot(x, y)
    distance, rows = np.hypot(ground, z), 2 + 3
    polar = np.empty((rows, 3))
    polar[:2] = np.stack([distance, np.arctan2(y, x), np.arctan2(z, ground)], axis=1)
    polar[:2] += rng.normal(0.0, [50.0, 0.00175, 0.0026], (2, 3))
    polar[2:] = rng.uniform([5e3, -3.0, 0.0], [6e4, 3.0, 0.4], (3, 3))
    polar[turn % 4, 2] = np.nan
    columns = {'elevation': polar[:, 2]}
    if range_rate:
        closing = (150.0 * x + np.array([0.0, 10.0]) * z) / distance
        columns['range_rate'] = np.concatenate(
            [closing + rng.normal(0.0, 2.0, 2), rng.uniform(-300.0, 300.0, 3)]
        )
    plots = Plots.polar(np.full(rows, time), polar[:, 0], polar[:, 1], **columns)
    return replace(plots, stamp=time)


@pytest.mark.parametrize('range_rate', [False, True], ids=['positions', 'range rates'])
@every_estimator
def test_estimator_follows_climbing_aircraft(name: str, range_rate: bool) -> None:
    """3-D radar with clutter and absent elevations: both are held, and published as they are."""
    rng = np.random.default_rng(6)
    config = with_values(
        RadarTrackerConfig(),
        {'estimator': name, 'motion.horizontal.acceleration_sd': [0.5, 10.0],
         'motion.vertical.acceleration_sd': [0.5, 5.0], 'sensor.dimensions': 3},
    )  # fmt: skip
    tracker = RadarTracker(config)
    nothing = tracker.tracks
    for turn in range(25):
        tracks = tracker.track(climbing(turn, rng, range_rate))
    state, covariance = kinematics(tracks, 'mmse')
    confirmed = tracks.confirmed & (tracks.hits > 15)
    assert confirmed.sum() == 2
    at = np.argsort(state[confirmed, 1])
    assert_allclose(state[confirmed][at, 1], [15_000.0, 25_000.0], atol=250.0)
    assert_allclose(state[confirmed][at, 3], 150.0, atol=25.0)
    assert (np.linalg.eigvalsh(covariance[confirmed]) > 0.0).all()
    columns = track_columns(nothing, tracks, 0.0, 'mmse', 0.997)
    assert ((columns['manoeuvre_probability'] >= 0.0) & (columns['p_0'] >= 0.0)).all()


@every_estimator
def test_estimator_follows_holding_aircraft_with_a_turning_antenna(name: str) -> None:
    """Terminal area, 3-D, an antenna that turns, 25 false plots a turn: most are confirmed."""
    config = preset('terminal_radar', estimator=name)
    tracker, near = RadarTracker(config), 0
    scans = list(islice(messages(build('terminal'), np.random.default_rng(5)), 40))
    for plots, _ in scans:
        tracks = tracker.track(plots)
    state, _ = kinematics(tracks, 'mmse')
    places = scans[-1][1].truth.position
    for place in places:
        off = np.linalg.norm(state[tracks.confirmed, :2] - place[:2], axis=1)
        near += off.min(initial=np.inf) < 1500.0
    assert near >= 0.75 * len(places)
    assert tracker.state.report.broken == 0


def around(look: int, rng: np.random.Generator) -> Plots:
    """Six contacts that pass the radar straight at 120 m/s, 90 % seen; 20 false plots."""
    time, nearest = PERIOD * look, np.linspace(8e3, 28e3, 6)
    seen, flown = rng.random(6) < 0.9, 120.0 * time
    azimuth = np.arange(6.0) - 3.0 + np.arctan2(flown, nearest)
    polar = np.stack([np.hypot(nearest, flown), azimuth], axis=1)[seen]
    polar += rng.normal(0.0, [50.0, 0.00175], polar.shape)
    polar = np.concatenate([polar, rng.uniform([1e3, -np.pi], [4e4, np.pi], (20, 2))])
    return replace(Plots.polar(np.full(len(polar), time), *polar.T), stamp=time)


@pytest.mark.parametrize('association', ['jpda_star', 'nearest', 'global_nearest'])
@every_estimator
def test_estimator_starts_from_one_plot(name: str, association: str) -> None:
    """Whatever shares the plots: all contacts are confirmed, though no start knows a velocity."""
    rng = np.random.default_rng(3)
    values = {'estimator': name, 'association': association, 'initiation.method': 'one_point',
              'initiation.speed_max': 300.0, 'motion.horizontal.acceleration_sd': [0.5, 10.0],
              'scan.assembly': 'snapshot'}  # fmt: skip
    tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    for look in range(25):
        tracks = tracker.track(around(look, rng))
    assert tracks.confirmed.sum() == 6
    assert (tracks.hits[tracks.confirmed] > 12).all()


def turned() -> tuple[np.ndarray, np.ndarray]:
    """Position and velocity (60, 2) of a contact at 150 m/s that turns by 3 deg/s for a minute."""
    time = np.arange(0.0, 60 * PERIOD, 0.1)
    heading = np.cumsum(np.where((time >= 80.0) & (time < 140.0), np.radians(3.0), 0.0)) * 0.1
    velocity = 150.0 * np.stack([np.cos(heading), np.sin(heading)], axis=1)
    position = [-15e3, 12e3] + np.cumsum(velocity, axis=0) * 0.1
    return position[::40], velocity[::40]


def ids_in_turn(name: str, seed: int, range_rate: bool) -> int:
    """Return how many confirmed tracks the contact has had; three false plots a look."""
    rng, ids = np.random.default_rng(seed), set()
    values = {'estimator': name, 'scan.assembly': 'snapshot', 'initiation.speed_max': 300.0}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    for look, (p, v) in enumerate(zip(*turned(), strict=True)):
        distance = np.hypot(*p)
        true = [distance, np.arctan2(p[1], p[0]), v @ p / distance]
        rows = rng.uniform([1e3, -np.pi, -300.0], [6e4, np.pi, 300.0], (4, 3))
        rows[0] = true + rng.normal(0.0, [50.0, 0.00175, 2.0])
        columns = {'range_rate': rows[:, 2]} if range_rate else {}
        plots = Plots.polar(np.full(4, PERIOD * look), rows[:, 0], rows[:, 1], **columns)
        tracks = tracker.track(replace(plots, stamp=PERIOD * look))
        ids |= set(tracks.id[tracks.confirmed].tolist())
    return len(ids)


@pytest.mark.parametrize('name', ['imm_alpha_beta', 'two_point'])
def test_range_rates_lose_no_contact_that_turns(name: str) -> None:
    """The gains do not follow range rates, and the gates must not hold the plots to them."""
    needed = [
        sum(ids_in_turn(name, seed, range_rate) for seed in range(12))
        for range_rate in (False, True)
    ]
    assert needed[1] <= needed[0]


def test_parameters_reach_the_estimators() -> None:
    """Gains, reading, detector, ramp and fuzzy sets of the parameters are those that are used."""
    values = {
        'alpha_beta.alpha': [0.2, 0.5, 0.8],
        'alpha_beta.covariance': 'recursion',
        'alpha_beta.stay_probability': 0.8,
        'alpha_beta.adaptive.false_alarm': 0.02,
        'alpha_beta.adaptive.ramp': 4,
        'alpha_beta.adaptive.restartable': True,
        'alpha_beta.fuzzy.false_alarm': 0.05,
        'alpha_beta.fuzzy.innovation_peaks': [0.0, 3.0],
        'alpha_beta.fuzzy.gain_peaks': [0.1, 0.9],
        'alpha_beta.fuzzy.rules': [0, 1, 1, 1],
    }

    def made(name):
        config = with_values(RadarTrackerConfig(), {'estimator': name, **values})
        return RadarTracker(config).core.setup.planes[0].estimator

    gains = (0.2, 0.5, 0.8)
    assert made('imm_alpha_beta') == ImmAlphaBeta(gains, 2, 'recursion', 0.8)
    adaptive = AdaptiveAlphaBeta(gains, 2, 'recursion', 0.02, 4, True, 0.8)
    assert made('adaptive_alpha_beta') == adaptive
    fuzzy = made('fuzzy_alpha_beta')
    assert fuzzy == FuzzyAlphaBeta(gains, 2, 'recursion', 0.05, fuzzy.rules, 0.8)
    assert fuzzy.rules.table == ((0, 1), (1, 1))
    assert fuzzy.rules.conclusion.peaks == (0.1, 0.9)


def test_turning_modes_may_be_steadier_than_the_straight_one() -> None:
    """The quiet mode is the quietest of its kind."""
    values = {'motion.horizontal.acceleration_sd': [0.5, 0.2, 9.0],
              'motion.horizontal.turn_rate': [0.0, 0.05, 0.0],
              'motion.horizontal.sojourn_time': [60.0, 30.0, 9.0]}  # fmt: skip
    assert with_values(RadarTrackerConfig(), values).motion.horizontal.turn_rate[1] == 0.05


@pytest.mark.parametrize(
    ('values', 'match'),
    [
        ({'alpha_beta.alpha': [0.3, 1.0]}, r'alpha_beta.alpha must be in \[0.01, 0.99\]'),
        ({'alpha_beta.alpha': []}, 'must have one value per mode'),
        (
            {'alpha_beta.alpha': [0.7, 0.3]},
            r'alpha must not fall from the quiet .*, got \[0.7, 0.3',
        ),
        ({'motion.horizontal.acceleration_sd': [9.0, 1.0]}, 'acceleration_sd must be least in'),
        ({'motion.vertical.acceleration_sd': [9.0, 1.0]}, 'must be least in the first mode'),
        ({'motion.horizontal.turn_rate': [0.1, 0.0]}, 'turn_rate must be 0 in the first mode'),
        ({'alpha_beta.covariance': 'joseph'}, 'must be one of steady_state, recursion'),
        ({'alpha_beta.fuzzy.rules': [0, 1]}, 'must have 4 x 4 entries'),
        ({'alpha_beta.fuzzy.gain_peaks': [0.5, 0.2]}, 'must be two or more, rising'),
        ({'estimator': 'kalman'}, 'must be one of markov_jump, markov_jump_joint'),
    ],
)
def test_bad_parameters_are_refused(values, match: str) -> None:
    """The message names the parameter and what is allowed."""
    with pytest.raises(ValueError, match=match):
        with_values(RadarTrackerConfig(), values)
