# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Scenario B-0 of [BAKULEV]: what 500 runs must show."""

from __future__ import annotations

import numpy as np
import pytest

from studies import bakulev
from studies.b0 import ALPHA, figures, FILTERS, PERIOD, play, scene, SPANS, truth
from studies.figures import Claim, Figures
from tracking_core.estimators import ImmAlphaBeta
from tracking_core.gains import benedict_bordner

RUNS = 500


@pytest.fixture(scope='module')
def values() -> Figures:
    """Figures of all filters."""
    return figures({name: play(make(), RUNS) for name, make in FILTERS.items()}, np.arange(RUNS))


@pytest.mark.parametrize('claim', bakulev.CLAIMS, ids=[claim.name for claim in bakulev.CLAIMS])
def test_figures_are_as_expected(values: Figures, claim: Claim) -> None:
    """Every figure of the study is inside its limits."""
    assert claim.holds(values[claim.name]), f'{values[claim.name]:.4g}, not {claim.limits}'


def test_baseline_that_may_restart_beats_the_recursion(values: Figures) -> None:
    """The lock of the baseline's detector makes most of the difference."""
    ours, base = values['recursion manoeuvre position'], values['locked manoeuvre position']
    assert values['restartable manoeuvre position'] < ours < base
    assert values['restartable quiet position'] < values['recursion quiet position']


@pytest.mark.parametrize('gains', [(0.2, 0.6), (0.3, 0.6), (0.3, 0.95), (0.45, 0.85)])
def test_gains_off_the_minimum_are_worse(gains: tuple[float, float]) -> None:
    """Least error of all contacts about (0.30..0.35, 0.80..0.90), 87.9 m within 3 %."""

    def error(alpha: tuple[float, float]) -> float:
        record = play(ImmAlphaBeta(alpha, 2, 'recursion'), 200)
        return float(np.sqrt(np.mean(record.position[SPANS['all']] ** 2)))

    least = min(error((a, b)) for a in (0.30, 0.35) for b in (0.80, 0.90))
    assert least == pytest.approx(87.9, rel=0.03)
    assert error(gains) > 1.01 * least


def test_path_turns_by_ninety_degrees() -> None:
    """Six accelerated steps; with the five of '50 T to 55 T' it would be 78.6 degrees."""
    velocity = truth()[:, 1::2]
    assert velocity[50] == pytest.approx([100.0, 0.0])
    assert np.degrees(np.arctan2(-velocity[56, 1], velocity[56, 0])) == pytest.approx(
        90.0, abs=0.1
    )
    assert np.degrees(np.arctan2(-velocity[55, 1], velocity[55, 0])) == pytest.approx(
        78.6, abs=0.1
    )


def plain_runs(runs: int, joseph: bool) -> tuple[float, float]:
    """
    Run [BAKULEV] eq. 8 to 16 in plain arrays, (T, J, state); P short or in the Joseph form.

    Returns the manoeuvre error, and the least variance that any innovation ever had over R.
    """
    measured, mean, covariance = scene(runs)
    F = np.kron(np.eye(2), [[1.0, PERIOD], [0.0, 1.0]])
    H, Pi = np.eye(4)[0::2], np.array([[0.9, 0.1], [0.1, 0.9]])
    alpha = np.array(ALPHA)
    pair = np.stack([alpha, benedict_bordner(alpha) / PERIOD], axis=1)
    K = np.stack([np.kron(np.eye(2), column[:, None]) for column in pair])
    keep = np.eye(4) - K @ H
    x, P = np.repeat(mean[:, None], 2, axis=1), np.repeat(covariance[:, None], 2, axis=1)
    mu, squared, least = np.full((runs, 2), 0.5), [], np.inf
    for k in range(1, len(measured.position)):
        R = measured.covariance[k][:, None]
        joint = mu[:, :, None] * Pi
        w = joint / joint.sum(axis=1)[:, None]
        x0 = np.einsum('tij,tis->tjs', w, x)
        d = x[:, :, None] - x0[:, None]
        P0 = np.einsum('tij,tijsr->tjsr', w, P[:, :, None] + d[..., :, None] * d[..., None, :])
        x, P = x0 @ F.T, F @ P0 @ F.T
        nu, S = measured.position[k][:, None] - x @ H.T, H @ P @ H.T + R
        least = min(least, float((np.einsum('tjaa->tja', S) / np.einsum('tjaa->tja', R)).min()))
        x = x + (K @ nu[..., None])[..., 0]
        P = keep @ P
        if joseph:
            P = P @ np.swapaxes(keep, -1, -2) + K @ R @ np.swapaxes(K, -1, -2)
        log = -0.5 * ((nu * np.linalg.solve(S, nu[..., None])[..., 0]).sum(axis=2)
                      + np.log(np.abs(np.linalg.det(S))))  # fmt: skip
        mu = joint.sum(axis=1) * np.exp(log - log.max(axis=1, keepdims=True))
        mu = mu / mu.sum(axis=1, keepdims=True)
        error = np.einsum('tj,tjs->ts', mu, x)[:, 0::2] - truth()[k, 0::2]
        squared.append((error**2).sum(axis=1))
    return float(np.sqrt(np.mean(np.array(squared)[SPANS['manoeuvre'][1:]]))), least


def test_joseph_form_in_plain_loops_equals_the_study(values: Figures) -> None:
    """An independent double loop over B-0 gives the same manoeuvre error."""
    error, least = plain_runs(RUNS, joseph=True)
    assert error == pytest.approx(values['recursion manoeuvre position'], rel=1e-6)
    assert least > 1.0


def test_short_form_of_the_covariance_loses_the_gain(values: Figures) -> None:
    """(I - K H) P holds for a Kalman gain only."""
    short, least = plain_runs(RUNS, joseph=False)
    assert least < 1.0  # an innovation less sure than its own plot: not a covariance
    assert short > 0.97 * values['locked manoeuvre position']


def test_report_is_written_with_its_figures(tmp_path) -> None:
    """Few runs: Markdown with all tables, both pictures beside it."""
    report = bakulev.describe(10, tmp_path)
    assert 'What does not hold' in report
    assert report.count('| holds |') + report.count('**does not hold**') >= len(bakulev.CLAIMS)
    for picture in ('bakulev_errors.png', 'bakulev_gains.png'):
        assert picture in report
        assert (tmp_path / picture).stat().st_size > 5_000
