# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where tracks come from, and how likely they are real."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest
from scipy.stats import multivariate_normal

from tracking_core.batches import Coverage, Seeds
from tracking_core.birth import with_velocity_prior
from tracking_core.density import Density
from tracking_core.faint_starts import share_of_faint
from tracking_core.initiation import one_point, plane_start, Starts, two_point
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.linalg import wrap_angle
from tracking_core.new_contacts import Odds, share_of_new, velocity_covariance

INTERVAL = 4.0
STARING = Coverage(INTERVAL, INTERVAL)
LIMITS = InitiationConfig(speed_max=300.0, climb_max=20.0)
THIN = Density(1e-9, 1e-9)


def plots(time, position, free=1.0, variance=400.0) -> Seeds:
    """Make plots with a correlated covariance."""
    position = np.atleast_2d(position).astype(float)
    K, d = position.shape
    covariance = np.tile(variance * (np.eye(d) + 0.3), (K, 1, 1))
    return Seeds(
        time=np.broadcast_to(np.asarray(time, float), K).copy(),
        position=position,
        covariance=covariance,
        free=np.full(K, free),
        clutter_volume=np.ones(K),
        relief=np.ones(K),
    )


def start(seeds: Seeds, fresh: Seeds, density=THIN, least: float = 0.0, config=LIMITS) -> Starts:
    """Two-point starts with P_D 0.9."""
    return two_point(seeds, fresh, density, STARING, INTERVAL, 0.9, least, config)


def test_two_point_gives_the_covariance_of_two_plots() -> None:
    """P = [R1, R1/T; R1/T, (R0 + R1)/T^2] for full R, by simulation of the noise."""
    rng = np.random.default_rng(1)
    old, new = plots(0.0, [[0.0, 0.0]], variance=900.0), plots(4.0, [[400.0, 100.0]])
    starts = start(old, new)
    mean, P = plane_start(starts, (0, 1))
    assert_allclose(mean[0], [400.0, 100.0, 100.0, 25.0])  # x, vx, y, vy
    e0 = rng.multivariate_normal(np.zeros(2), old.covariance[0], 200_000)
    e1 = rng.multivariate_normal(np.zeros(2), new.covariance[0], 200_000)
    velocity = (e1 - e0) / 4.0
    error = np.stack([e1[:, 0], velocity[:, 0], e1[:, 1], velocity[:, 1]], axis=1)
    scale = np.sqrt(np.diag(P[0]))
    assert_allclose(P[0] / np.outer(scale, scale), np.cov(error.T) / np.outer(scale, scale),
                    atol=0.01)  # fmt: skip


def test_plane_start_takes_the_coordinates_of_a_plane() -> None:
    """The vertical plane of a 3-D start is (z, vz), the horizontal one is full."""
    starts = start(plots(0.0, [[0.0, 0.0, 0.0]]), plots(4.0, [[40.0, 80.0, 8.0]]))
    mean, P = plane_start(starts, (2,))
    assert_allclose(mean, [[8.0, 2.0]])
    assert_allclose(P[0], [[520.0, 130.0], [130.0, 65.0]])
    mean, P = plane_start(starts, (0, 1))
    assert_allclose(mean, [[40.0, 10.0, 80.0, 20.0]])
    assert P[0, 0, 2] == pytest.approx(0.3 * 400.0)
    assert P[0, 1, 3] == pytest.approx(0.3 * 800.0 / 16.0)


@pytest.mark.parametrize(
    ('position', 'time', 'fits'),
    [
        ((1190.0, 0.0, 0.0), 4.0, True),
        ((900.0, 900.0, 0.0), 4.0, True),  # 1273 m less the noise
        ((1400.0, 0.0, 0.0), 4.0, False),  # too fast
        ((1100.0, 1100.0, 0.0), 4.0, False),  # too fast across the axes
        ((0.0, 0.0, 150.0), 4.0, True),
        ((0.0, 0.0, -190.0), 4.0, False),  # dives too steeply
        ((0.0, 0.0, 0.0), 1.9, False),  # of the same look
        ((0.0, 0.0, 0.0), -4.0, False),  # before it
    ],
)
def test_two_point_keeps_the_speed_limits(position, time: float, fits: bool) -> None:
    """Speed 300 m/s, climb 20 m/s, each plus three sigma of both plots (97 m), after a look."""
    starts = start(plots(0.0, [[0.0, 0.0, 0.0]]), plots(time, [position]))
    assert len(starts.plot) == fits


def test_two_point_existence_equals_bayes() -> None:
    """One old plot, three within reach: who was it? Enumerated."""
    density = Density(clutter=3e-7, new_contacts=1e-7)
    old = plots(0.0, [[0.0, 0.0]], free=0.8)
    new = plots(4.0, [[100.0, 0.0], [0.0, 500.0], [-900.0, 0.0]])
    starts = start(old, new, density)
    # A contact's velocity is Gaussian with the variance of an even one on the disc of the limit.
    spread = 2.0 * old.covariance[0] + 300.0**2 / 4.0 * 4.0**2 * np.eye(2)
    second = multivariate_normal(np.zeros(2), spread).pdf(new.position)
    likely = 0.9 * second / 4e-7
    evidence = np.array([likely.sum() - 0.9])
    contact = 0.8 * share_of_new(0.25, np.ones(1), evidence, old.free, np.ones(1, bool))[0]
    weights = np.array([*(contact * likely), contact * 0.1, 1.0 - contact])
    assert_array_equal(starts.plot, [0, 1, 2])
    assert_allclose(starts.existence_probability, (weights / weights.sum())[:3], rtol=1e-12)


def test_two_point_counts_the_looks_between() -> None:
    """A second plot two looks later needs a miss between, and leaves more room."""
    density = Density(clutter=3e-7, new_contacts=1e-7)
    near, far = (
        start(plots(0.0, [[0.0, 0.0]]), plots(time, [[0.0, 0.0]]), density) for time in (4.0, 8.0)
    )
    assert far.existence_probability[0] < 0.2 * near.existence_probability[0]


def test_two_point_does_not_start_in_dense_clutter() -> None:
    """Starts less likely than asked for are left out."""
    seeds, fresh = plots(0.0, [[0.0, 0.0]]), plots(4.0, [[0.0, 0.0]])
    thin = start(seeds, fresh, Density(1e-8, 1e-8), least=0.01)
    dense = start(seeds, fresh, Density(1e-4, 1e-8), least=0.01)
    assert len(thin.plot) == 1
    assert len(dense.plot) == 0


def test_two_point_starts_faint_tracks_in_clutter_but_not_too_many() -> None:
    """Where two plots of a contact prove little, the likeliest pairs are followed, 30 a look."""
    grid = np.stack(np.meshgrid(np.arange(20), np.arange(20)), axis=-1).reshape(-1, 2) * 5e3
    seeds, fresh = plots(0.0, grid), plots(4.0, grid + np.arange(400)[:, None])
    density = Density(clutter=2e-7, new_contacts=1e-12)
    starts = start(seeds, fresh, density, least=0.01)
    assert starts.existence_probability.max() < 0.01
    assert_array_equal(np.sort(starts.plot), np.arange(30))
    assert starts.leniency > 1.0
    few = start(seeds, fresh, density, least=0.01, config=replace(LIMITS, faint_starts=7))
    assert_array_equal(np.sort(few.plot), np.arange(7))
    none = start(seeds, fresh, density, least=0.01, config=replace(LIMITS, faint_starts=0))
    assert len(none.plot) == 0
    assert none.leniency == 1.0
    assert len(start(seeds, fresh, Density(1e-12, 1e-11), least=0.01).plot) == 400
    fifth = Coverage(INTERVAL - 0.8, INTERVAL, 0.0, 0.4 * np.pi)
    sector = two_point(seeds, fresh, density, fifth, INTERVAL, 0.9, 0.01, LIMITS)
    assert_array_equal(np.sort(sector.plot), np.arange(6))  # of the fifth of a turn


def test_two_point_keeps_the_climb_limit_at_each_plot_s_own_time() -> None:
    """65 m higher is too much after 2.5 s, and not after 4 s, at 20 m/s."""
    seeds = plots(0.0, [[0.0, 0.0, 0.0], [5e3, 0.0, 0.0]], variance=1.0)
    fresh = plots([2.5, 4.0], [[0.0, 0.0, 65.0], [5e3, 0.0, 65.0]], variance=1.0)
    assert_array_equal(start(seeds, fresh).plot, [1])


@pytest.mark.parametrize('sense', [1.0, -1.0])
@pytest.mark.parametrize('sectors', [3, 8, 32, 100, 128, 720])
def test_share_of_faint_is_right_over_a_turn_and_fair_over_many(
    sectors: int, sense: float
) -> None:
    """However a turn is cut it has 30; where they are fewer than sectors, each has its turn."""
    angle, begin = 2.0 * np.pi / sectors, 1.7e9
    shares = np.array([
        share_of_faint(30, Coverage(
            begin + k * 4.0 / sectors, begin + (k + 1) * 4.0 / sectors,
            float(wrap_angle(np.array(1.0 + sense * k * angle))), sense * angle,
        ), THIN)
        for k in range(100 * sectors)
    ]).reshape(100, sectors)  # fmt: skip
    assert_allclose(shares.sum(axis=1), 30, atol=2)
    assert shares.sum() == pytest.approx(3000, rel=0.01)
    assert_allclose(shares.mean(axis=0), 30.0 / sectors, atol=0.05)
    assert shares.min() >= 0


@pytest.mark.parametrize('turn', [1.0, 3.0, 30.0])
def test_share_of_faint_is_fair_however_fast_the_antenna_turns(turn: float) -> None:
    """Ten in a turn of 32 sectors: over 100 turns each sector has its part."""
    angle = 2.0 * np.pi / 32.0
    shares = np.array([
        share_of_faint(10, Coverage(
            k * turn / 32.0, (k + 1) * turn / 32.0, k % 32 * angle, angle
        ), THIN)
        for k in range(3200)
    ]).reshape(100, 32)  # fmt: skip
    assert_allclose(shares.mean(axis=0), 10.0 / 32.0, atol=0.05)


def test_share_of_faint_of_a_look_everywhere_is_all() -> None:
    """Of a full turn, too."""
    assert share_of_faint(30, Coverage(0.0, 4.0), THIN) == 30
    assert share_of_faint(30, Coverage(0.0, 4.0, 1.0, -6.28), THIN) == 30


def test_two_point_takes_nothing() -> None:
    """No old plots, no fresh ones, neither."""
    one, none = plots(0.0, [[0.0, 0.0]]), plots(0.0, np.zeros((0, 2)))
    for seeds, fresh in ((one, none), (none, one), (none, none)):
        starts = start(seeds, fresh)
        assert starts.mean.shape == (0, 2, 2)
        assert starts.covariance.shape == (0, 2, 2, 2, 2)


def test_odds_at_best_are_those_of_a_plot_in_the_same_place() -> None:
    """The bound by which seeds are sorted out equals the odds of the pair without a step."""
    seeds = plots([0.0, 0.0, 4.0], [[0.0, 5.0, 1.0], [40.0, 80.0, 8.0], [7.0, 7.0, 7.0]])
    odds = Odds(Density(1e-9, 1e-9), 0.9, LIMITS)
    step, dt = np.zeros((3, 3)), np.full(3, INTERVAL)
    pair = odds.of_plots(seeds) * odds.of_steps(2.0 * seeds.covariance, step, dt)
    assert_allclose(odds.at_best(seeds, INTERVAL), pair, rtol=1e-12)


def test_one_point_starts_at_rest_with_a_velocity_prior() -> None:
    """Covariance R, speed_max^2 / 4 on a disc, climb_max^2 / 3 on a line, nothing across."""
    fresh = plots(0.0, [[10.0, 20.0, 30.0], [0.0, 0.0, 0.0]], free=0.5)
    starts = one_point(fresh, 0.4, LIMITS)
    mean, P = plane_start(starts, (0, 1))
    assert_allclose(mean[0], [10.0, 0.0, 20.0, 0.0])
    expected = np.zeros((4, 4))
    expected[0::2, 0::2] = fresh.covariance[0, :2, :2]
    expected[1::2, 1::2] = np.diag([22_500.0, 22_500.0])
    assert_allclose(P[0], expected)
    _, vertical = plane_start(starts, (2,))
    assert vertical[0, 1, 1] == pytest.approx(400.0 / 3.0)
    assert_allclose(starts.existence_probability, [0.2, 0.2])
    assert starts.hits == 1


def test_with_velocity_prior_equals_a_measurement_of_no_velocity() -> None:
    """Means and covariances as of a Kalman update with v = 0, as unsure as velocities are."""
    old, new = plots(0.0, [[0.0, 0.0]]), plots(4.0, [[100.0, 300.0]])
    starts = start(old, new, Density(1e-12, 1e-12))
    P, x = starts.covariance[0].reshape(4, 4), starts.mean[0].reshape(4)
    H = np.eye(4)[[1, 3]]
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + 22_500.0 * np.eye(2))
    tamed = with_velocity_prior(starts, LIMITS)
    assert_allclose(tamed.mean[0].reshape(4), x - K @ H @ x, rtol=1e-9)
    assert_allclose(tamed.covariance[0].reshape(4, 4), P - K @ H @ P, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(('d', 'speed_sd'), [(1, 0.0), (2, 0.0), (3, 0.0), (2, 50.0), (3, 500.0)])
def test_velocities_are_spread_evenly_within_the_limits(d: int, speed_sd: float) -> None:
    """On a line of rates, on a disc of speeds, between the climb limits; a smaller sd counts."""
    config = InitiationConfig(speed_max=300.0, climb_max=20.0, speed_sd=speed_sd)
    rng = np.random.default_rng(1)
    velocity = rng.uniform(-1.0, 1.0, (200_000, d)) * ([300.0, 300.0, 20.0][:d])
    if d > 1:
        velocity = velocity[np.hypot(velocity[:, 0], velocity[:, 1]) < 300.0]
    expected = np.cov(velocity.T).reshape(d, d).diagonal().copy()
    if speed_sd == 50.0:
        expected[:2] = speed_sd**2
    assert_allclose(velocity_covariance(d, config), np.diag(expected), rtol=0.01, atol=1e-9)
