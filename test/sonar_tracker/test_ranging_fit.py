# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The fit of straight courses to bearings, and the verdict on it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest
from scipy.optimize import least_squares

from sonar_tracker.bearing_history import PastMarks
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.ranging_fit import fit
from sonar_tracker.ranging_model import compare, courses, distances, Legs, legs_of, residuals
from sonar_tracker.ranging_verdict import judge
from studies.v0_ranging import Case, range_bound, scene
from tracking_core.linalg import wrap_angle
from tracking_core.rows import take


def points(contacts: int, seed: int = 1, sd: float = 2e-3) -> PastMarks:
    """Return marks of contacts round an own ship that turns, every 10 s."""
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, 1500.0, 10.0)
    own = scene(Case(turn=80.0))[1][:750:5, :2] * 2.0
    start = rng.uniform(-6000.0, 6000.0, (contacts, 1, 2))
    velocity = rng.uniform(-4.0, 4.0, (contacts, 1, 2))
    line = start + velocity * time[:, None] - own
    bearing = wrap_angle(
        np.arctan2(line[..., 1], line[..., 0]) + sd * rng.standard_normal(line.shape[:2])
    )
    shape = bearing.shape
    return PastMarks(
        np.broadcast_to(time, shape), bearing, np.full(shape, sd**-2),
        np.broadcast_to(own, (*shape, 2)), np.full(contacts, 150),
    )  # fmt: skip


def test_fit_equals_least_squares() -> None:
    """The best of scipy's least squares in Cartesian coordinates, contact by contact."""
    heard = points(20)
    legs = legs_of(heard)
    state, _ = courses(fit(legs, 50.0, 1e5).state, legs)
    for row in range(20):

        def off(x, row=row):
            since = (heard.time[row] - heard.time[row, -1])[:, None]
            line = x[:2] + x[2:] * since - heard.own[row]
            return wrap_angle(heard.bearing[row] - np.arctan2(line[:, 1], line[:, 0])) * 500.0

        best = least_squares(off, state[row], x_scale=[1e3, 1e3, 1.0, 1.0], xtol=1e-12, ftol=1e-12)
        assert_allclose((off(state[row]) ** 2).sum(), 2.0 * best.cost, rtol=1e-5)


def test_fit_finds_the_best_range_from_any_side() -> None:
    """No other start has a lower chi-square: ranges tried are near enough to each other."""
    heard = points(60, seed=4)
    legs = legs_of(heard)
    best = fit(legs, 50.0, 1e5)
    assert (best.chi_square < 2.0 * 150).all()
    assert best.chi_square.mean() == pytest.approx(146.0, rel=0.05)


def test_fit_of_a_batch_equals_its_members() -> None:
    """Contacts do not meddle with each other."""
    heard = points(12)
    together = fit(legs_of(heard), 50.0, 1e5)
    for row in range(12):
        alone = fit(legs_of(take(heard, slice(row, row + 1))), 50.0, 1e5)
        assert_allclose(alone.state[0], together.state[row], rtol=1e-7, atol=1e-9)


def test_fit_ignores_rows_without_weight() -> None:
    """Points beyond the number of a track are no data."""
    heard = points(6)
    padded = PastMarks(
        np.pad(heard.time, ((0, 0), (0, 9))), np.pad(heard.bearing, ((0, 0), (0, 9))),
        np.pad(heard.weight, ((0, 0), (0, 9))), np.pad(heard.own, ((0, 0), (0, 9), (0, 0))),
        heard.count,
    )  # fmt: skip
    assert_allclose(fit(legs_of(padded), 50.0, 1e5).state, fit(legs_of(heard), 50.0, 1e5).state,
                    rtol=1e-9, atol=1e-12)  # fmt: skip


def exact(legs: Legs) -> np.ndarray:
    """Return some states (T, 4)."""
    return fit(legs, 50.0, 1e5).state * np.array([1.0, 1.1, 0.9, 1.2])


def test_slopes_are_derivatives() -> None:
    """The slope of the bearings and of the course, against differences."""
    legs = legs_of(points(8))
    state = exact(legs)
    residual, slope = compare(state, legs)
    assert_allclose(residuals(state, legs), residual)
    _, jacobian = courses(state, legs)
    for n in range(4):
        step = 1e-6 * np.eye(4)[n]
        change = (compare(state + step, legs)[0] - compare(state - step, legs)[0]) / 2e-6
        assert_allclose(-change, slope[..., n], rtol=1e-4, atol=1e-4)
        moved = (courses(state + step, legs)[0] - courses(state - step, legs)[0]) / 2e-6
        assert_allclose(moved, jacobian[..., n], rtol=1e-5, atol=1e-2)


def test_distances_are_those_of_the_course() -> None:
    """Where the model puts the contact is where the straight course was."""
    heard = points(5)
    legs = legs_of(heard)
    state = exact(legs)
    course, _ = courses(state, legs)
    since = (heard.time - heard.time[:, -1:])[..., None]
    line = course[:, None, :2] + course[:, None, 2:] * since - heard.own
    distance, bearing = distances(state, legs)
    assert_allclose(distance, np.hypot(line[..., 0], line[..., 1]), rtol=1e-9)
    assert_allclose(np.cos(bearing - np.arctan2(line[..., 1], line[..., 0])), 1.0, atol=1e-12)


def test_covariance_is_the_bound() -> None:
    """On marks without error the range sd is that of Cramer and Rao."""
    time, own, objects = scene(Case())
    line = objects[:, :, :2] - own[:, :2]
    shape = line.shape[:2]
    heard = PastMarks(np.broadcast_to(time, shape), np.arctan2(line[..., 1], line[..., 0]),
                   np.full(shape, 1e6), np.broadcast_to(own[:, :2], line.shape),
                   np.full(2, len(time)))  # fmt: skip
    legs = legs_of(heard)
    found = judge(fit(legs, 50.0, 1e5), legs, RangingConfig())
    along = line[:, -1] / np.hypot(*line[:, -1].T)[:, None]
    sd = np.sqrt(np.einsum('tx,txy,ty->t', along, found.covariance[:, :2, :2], along))
    assert_allclose(sd, [range_bound(time, one, 1e-3) for one in line], rtol=1e-5)
    assert_allclose(found.state, objects[:, -1], rtol=1e-6, atol=1e-3)


def test_verdict_stands_drifting_velocities() -> None:
    """What drift adds to the error of 1 / range is what 400 drifting contacts show."""
    drift = 0.02
    heard = take(points(1, seed=6), np.zeros(400, np.int64))
    still = points(1, seed=6, sd=1e-6)
    rng = np.random.default_rng(8)
    walk = np.cumsum(drift * np.sqrt(10.0) * rng.standard_normal((400, 150, 2)), axis=1)
    moved = 10.0 * np.cumsum(walk - 0.5 * np.diff(walk, axis=1, prepend=0.0), axis=1)
    moved -= moved[:, -1:] + walk[:, -1:] * (heard.time - 1490.0)[..., None]
    true = courses(fit(legs_of(still), 50.0, 1e5).state, legs_of(still))[0]
    line = true[:, None, :2] + true[:, None, 2:] * (heard.time - 1490.0)[..., None] - heard.own
    line = line + moved
    legs = legs_of(replace(heard, bearing=np.arctan2(line[..., 1], line[..., 0])))
    best = fit(legs, 50.0, 1e5)
    spread = best.state[:, 3].std() / best.state[:, 3].mean()
    sure = replace(best, chi_square=np.zeros(400), serial=np.zeros(400))
    shares = [
        judge(sure, legs, RangingConfig(relative_sd=limit, velocity_noise=drift)).observable.mean()
        for limit in (0.75 * spread, 1.3 * spread)
    ]
    assert shares[0] < 0.2
    assert shares[1] > 0.8


@pytest.mark.parametrize(
    ('change', 'observable', 'bent'),
    [
        ({}, True, False),
        ({'chi_square': np.full(1, 240.0), 'serial': np.full(1, 3.0)}, False, False),
        ({'chi_square': np.full(1, 280.0), 'serial': np.full(1, 5.5)}, False, True),
        ({'chi_square': np.full(1, 160.0), 'serial': np.full(1, 4.5)}, False, False),
        ({'serial': np.full(1, 7.0)}, False, True),
    ],
)
def test_verdict_wants_small_and_white_residuals(change, observable: bool, bent: bool) -> None:
    """A fit that explains the marks badly is not believed, however small its sd."""
    legs = legs_of(points(1))
    best = replace(fit(legs, 50.0, 1e5), **change)
    found = judge(best, legs, RangingConfig())
    assert (bool(found.observable[0]), bool(found.bent[0])) == (observable, bent)


@pytest.mark.parametrize('factor', [0.5, 2.0])
def test_verdict_hears_how_noisy_the_marks_are(factor: float) -> None:
    """Marks that tell half their sd have a range and its true sd, and twice their sd, too."""
    heard, still = points(200, seed=9), legs_of(points(200, seed=9, sd=1e-7))
    legs = legs_of(replace(heard, weight=heard.weight / factor**2))
    found = judge(fit(legs, 50.0, 1e5), legs, RangingConfig(velocity_noise=0.0))
    true = courses(fit(still, 50.0, 1e5).state, still)[0]
    off = (found.state - true)[:, :2]
    square = np.einsum('tx,txy,ty->t', off, np.linalg.inv(found.covariance[:, :2, :2]), off)
    assert found.observable.mean() > 0.8
    assert not found.bent.any()
    usual = np.median(square[found.observable]) / 1.386  # of chi-square with two components
    assert usual == pytest.approx(1.0 / max(factor, 1.0) ** 2, rel=0.3)


def test_marks_that_tell_too_large_an_sd_do_not_hide_a_bend() -> None:
    """A contact that turns is noticed by how its residuals follow each other."""
    heard = points(60, seed=11)
    swing = 3e-3 * np.sin(2.0 * np.pi * heard.time / 600.0)
    legs = legs_of(replace(heard, bearing=heard.bearing + swing, weight=heard.weight / 4.0))
    found = judge(fit(legs, 50.0, 1e5), legs, RangingConfig())
    assert found.bent.mean() > 0.9
