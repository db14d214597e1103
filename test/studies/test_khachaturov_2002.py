# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Scenario K-0 of [KHACH02]: what 2000 runs must show."""

from __future__ import annotations

import numpy as np
import pytest

from studies import khachaturov_2002
from studies.figures import Claim, Figures
from studies.k0 import ACCELERATIONS, BEGIN, END, figures, GRAVITY, PERIOD, play, tenths, truth
from studies.khachaturov_2002 import CLAIMS

RUNS = 2000


@pytest.fixture(scope='module')
def values() -> Figures:
    """Figures of all filters."""
    return figures(*play(RUNS), np.arange(RUNS))


@pytest.mark.parametrize('claim', CLAIMS, ids=[claim.name for claim in CLAIMS])
def test_figures_are_as_expected(values: Figures, claim: Claim) -> None:
    """Every figure of the study is inside its limits."""
    assert claim.holds(values[claim.name]), f'{values[claim.name]:.4g}, not {claim.limits}'


@pytest.mark.parametrize('a', ACCELERATIONS)
def test_kalman_filter_of_two_motions_beats_the_fuzzy_filter(values: Figures, a: float) -> None:
    """By at least 10 % in every manoeuvre, without being worse on a straight path."""
    kalman, fuzzy = (values[f'{name} {tenths(a)} manoeuvre'] for name in ('kalman', 'fuzzy'))
    assert kalman < 0.9 * fuzzy
    assert values['kalman 0 manoeuvre'] < values['fuzzy 0 manoeuvre']


def test_path_accelerates_for_ten_steps() -> None:
    """Straight, a g, straight: second differences of the path."""
    push = np.diff(truth(0.5), 2) / (PERIOD**2 * GRAVITY)
    assert push[: BEGIN - 1] == pytest.approx(0.0, abs=1e-9)
    assert push[BEGIN : END - 1] == pytest.approx(0.5)
    assert push[END:] == pytest.approx(0.0, abs=1e-9)


def test_report_is_written_with_its_figures(tmp_path) -> None:
    """Few runs: Markdown with all tables, both pictures beside it."""
    report = khachaturov_2002.describe(20, tmp_path)
    assert 'beats the fuzzy filter' in report
    for picture in ('khachaturov_2002_errors.png', 'khachaturov_2002_surface.png'):
        assert picture in report
        assert (tmp_path / picture).stat().st_size > 5_000
