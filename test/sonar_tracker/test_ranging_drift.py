# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The sd of a range is that of contacts that stray as far as their marks allow."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from sonar_tracker.bearing_history import PastMarks
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.ranging_drift import strayed
from sonar_tracker.ranging_fit import fit
from sonar_tracker.ranging_heading import with_wandering
from sonar_tracker.ranging_model import courses, legs_of
from sonar_tracker.ranging_verdict import judge
from studies.v0_ranging import Case, scene
from tracking_core.linalg import wrap_angle

DRIFTS, CHANGES = (0.01, 0.03, 0.1, 0.3, 1.0), 8
TIME = np.arange(0.0, 1500.0, 10.0)
OWN = scene(Case(turn=80.0))[1][:750:5, :2] * 2.0


def heard(path, sd=2e-3, seed=1) -> PastMarks:
    """Return marks of contacts on these paths (T, K, 2)."""
    line = path - OWN
    noise = sd * np.random.default_rng(seed).standard_normal(line.shape[:2])
    bearing = wrap_angle(np.arctan2(line[..., 1], line[..., 0]) + noise)
    shape = bearing.shape
    return PastMarks(
        np.broadcast_to(TIME, shape), bearing, np.full(shape, sd**-2),
        np.broadcast_to(OWN, (*shape, 2)), np.full(len(path), shape[1]),
    )  # fmt: skip


def paths(contacts: int, drift: float, seed: int = 3):
    """Return paths (T, K, 2) of contacts whose velocity is a random walk."""
    rng = np.random.default_rng(seed)
    start = rng.uniform(-6000.0, 6000.0, (contacts, 1, 2))
    velocity = rng.uniform(-4.0, 4.0, (contacts, 1, 2))
    steps = drift * np.sqrt(10.0) * rng.standard_normal((contacts, len(TIME), 2))
    return start + np.cumsum(10.0 * (velocity + np.cumsum(steps, axis=1)), axis=1)


def off(path, sd=2e-3, **values):
    """Return by how many of their sds the ranges that are told are off, NaN: not told."""
    legs = legs_of(heard(path, sd))
    config = RangingConfig(heading_noise=0.0, **values)
    found = judge(fit(legs, 50.0, 1e5), legs, config)
    line, true = found.state[:, :2] - OWN[-1], path[:, -1] - OWN[-1]
    distance = np.hypot(*line.T)
    along = line / distance[:, None]
    sd = np.sqrt(np.einsum('tx,txy,ty->t', along, found.covariance[:, :2, :2], along))
    told = found.observable & (sd < 0.2 * distance)
    return np.where(told, (distance - np.hypot(*true.T)) / sd, np.nan)


@pytest.mark.parametrize(('drift', 'share'), [(0.0, 0.01), (0.003, 0.2), (0.01, 0.15)])
def test_ranges_of_contacts_that_stray_are_within_their_sd(drift: float, share: float) -> None:
    """So many are more than three sds off; of contacts taken for straight 0, 0.46 and 0.73."""
    found = off(paths(400, drift))
    told = np.isfinite(found)
    assert told.sum() > 100
    assert (np.abs(found[told]) > 3.0).mean() < share


def test_ranges_of_straight_courses_keep_their_sd() -> None:
    """As good as the bound where the marks are sure of it: contacts do go straight."""
    path = paths(200, 0.0)
    strayed_off, straight_off = off(path, 2e-4), off(path, 2e-4, velocity_noise=0.0)
    both = np.isfinite(strayed_off) & np.isfinite(straight_off)
    assert both.sum() > 150
    assert np.median(straight_off[both] / strayed_off[both]) < 1.05


@pytest.mark.parametrize('wanders', [False, True])
def test_strayed_equals_the_mixture_of_longer_states(wanders: bool) -> None:
    """Course and changes of velocity as one unknown, drift by drift, with dense likelihoods."""
    path = paths(3, 0.02)
    legs = legs_of(heard(path))
    if wanders:
        legs = with_wandering(legs, 0.003)
    best, usual, noise = fit(legs, 50.0, 1e5), 0.02, np.array([1.0, 1.5, 2.0])
    bound = noise[:, None, None] * np.linalg.inv(best.information)
    found = strayed(bound, best, legs, noise, usual)
    course = courses(best.state, legs)[0]
    age = TIME[-1] - TIME
    for row in range(3):
        line = course[row, :2] - course[row, 2:] * age[:, None] - OWN
        step = legs.span[row] / CHANGES
        way = np.maximum(age[:, None] - step * (np.arange(CHANGES) + 0.5), 0.0) * np.sqrt(step)
        across = np.stack([-line[:, 1], line[:, 0]], axis=1) / (line**2).sum(axis=1)[:, None]
        D = np.concatenate([across[:, :1] * way, across[:, 1:] * way], axis=1) / 2e-3
        if wanders:
            D = legs.whitening[row] @ D
        root = np.sqrt(noise[row])
        J, e, D = best.slope[row] / root, best.residual[row] / root, D / root
        second, chance = [np.linalg.inv(J.T @ J)], [0.003 / usual]
        for drift in DRIFTS:
            G = np.concatenate([J, D], axis=1)
            normal = G.T @ G
            normal[4:, 4:] += np.eye(2 * CHANGES) / drift**2
            P = np.linalg.inv(normal)
            mean = (P @ G.T @ e)[:4]
            second.append(P[:4, :4] + np.outer(mean, mean))
            S = np.eye(len(e)) + drift**2 * D @ D.T
            A = J.T @ np.linalg.solve(S, J)
            logs = np.linalg.slogdet(S)[1] + np.linalg.slogdet(A)[1]
            logs += e @ np.linalg.solve(S, e) - np.linalg.slogdet(J.T @ J)[1] - e @ e
            b = J.T @ np.linalg.solve(S, e)
            logs -= b @ np.linalg.solve(A, b)
            chance.append(min(usual / drift, drift / usual) * np.exp(-0.5 * logs))
        expected = np.einsum('v,vab->ab', np.array(chance) / sum(chance), np.array(second))
        scale = np.sqrt(np.diag(expected))
        assert_allclose(found[row] / np.outer(scale, scale), expected / np.outer(scale, scale),
                        atol=1e-3)  # fmt: skip
