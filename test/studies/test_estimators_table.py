# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The table of all estimators: courses, phases, and what the text above it says."""

from __future__ import annotations

import numpy as np
import pytest

from studies import estimators
from studies.comparison import follow
from studies.courses import Course, courses
from tracking_core.estimators import ESTIMATORS

RUNS = 60


@pytest.fixture(scope='module')
def by_name() -> dict[str, Course]:
    """All courses."""
    return {course.name: course for course in courses(RUNS)}


def test_phases_divide_a_course(by_name: dict[str, Course]) -> None:
    """Every settled contact belongs to one phase; velocities are those of the path."""
    for course in by_name.values():
        phases = np.stack([course.straight, course.turning, course.after])
        assert (phases.sum(axis=0)[8:] == 1).all()
        assert phases.any(axis=1).all()
        moved = np.diff(course.position, axis=0) / course.period
        between = 0.5 * (course.velocity[1:] + course.velocity[:-1])
        assert np.abs(moved - between).max() < 0.05 * np.abs(course.velocity).max()


@pytest.mark.parametrize('name', ESTIMATORS)
def test_estimator_is_better_than_the_plots_on_straight_legs(
    by_name: dict[str, Course], name: str
) -> None:
    """Position error below the plots', and a covariance that does not promise too much."""
    for course in by_name.values():
        if name == 'markov_jump_joint' and course.position.shape[1] != 3:
            continue
        row = follow(name, course)
        assert row.position['straight'] < 0.95
        assert row.nees['straight'] < 1.2


def test_default_is_never_much_worse_than_the_plots_in_turns(by_name: dict[str, Course]) -> None:
    """The claim behind the advice: markov_jump in turns, on every course."""
    for course in by_name.values():
        row = follow('markov_jump', course)
        assert row.position['turning'] < 1.05
        assert row.found > 0.95
        assert row.nees['turning'] < 3.5


def test_lag_is_in_the_covariance_of_a_fixed_gain(by_name: dict[str, Course]) -> None:
    """A filter that lags says so: `recursion`, which does not, has ten times the NEES."""
    course = by_name['K-0, 1 g']
    honest = follow('adaptive_alpha_beta', course)
    blind = follow(
        'adaptive_alpha_beta',
        Course(**{**vars(course), 'parameters': {
            **course.parameters, 'alpha_beta.covariance': 'recursion'}}),
    )  # fmt: skip
    assert blind.nees['turning'] > 5.0 * honest.nees['turning']


def test_report_has_every_estimator_on_every_course() -> None:
    """Few runs, without the recordings."""
    report = estimators.describe(10, with_real=False)
    for name in ESTIMATORS:
        assert report.count(f'\n| {name} |') == (2 if name == 'markov_jump_joint' else 6)
