# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Scenario Z-0 of [ZHUK09]: golden values of one run, and what 500 runs must show."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from studies.figures import Claim, Figures
from studies.passes import measure, run, Step, two_point_start
from studies.z0 import CONTACTS, figures, paper_planes, PERIOD, play, SD, SEED
from studies.zhuk_2009 import CLAIMS
from tracking_core.batches import Coverage, Seeds
from tracking_core.density import Density
from tracking_core.initiation import plane_start, two_point
from tracking_core.lifecycle_config import InitiationConfig
from tracking_tools.scenarios.studies import z0_path

GOLDEN = {  # plot; manoeuvre probability and mixture of the horizontal, of the vertical plane
    2: (
        (167327.798, 133950.909, 8691.35),
        (0.3007606, (167168.446, -338.929, 134023.436, -305.708)),
        (0.4476248, (8605.116, -22.557)),
    ),
    20: (
        (98725.166, 79857.241, 9268.943),
        (0.9999997, (98629.511, 286.311, 79899.235, -500.604)),
        (0.1123685, (9370.286, 14.281)),
    ),
    31: (
        (136846.336, 43754.857, 1304.885),
        (0.9992947, (136917.863, -213.022, 43687.57, -385.779)),
        (0.3852831, (1382.531, -49.936)),
    ),
}


@pytest.fixture(scope='module')
def measured():
    """All contacts of run 0."""
    truth = z0_path().at(PERIOD * np.arange(CONTACTS))[0]
    noise = np.random.default_rng(SEED).standard_normal((500, CONTACTS, 3))[:1]
    return measure(truth, SD, noise)


@pytest.fixture(scope='module')
def steps(measured) -> list[list[Step]]:
    """All steps of run 0, by plane."""
    return run(paper_planes(), measured, PERIOD)


@pytest.fixture(scope='module')
def values() -> Figures:
    """Figures of 500 runs."""
    return figures(play(500), np.arange(500))


@pytest.mark.parametrize('contact', GOLDEN)
def test_measure_gives_the_published_plots(measured, contact: int) -> None:
    """Path, noise and conversion are those of the golden run."""
    assert_allclose(measured.position[contact, 0], GOLDEN[contact][0], rtol=0.0, atol=0.01)


@pytest.mark.parametrize('plane', [0, 1], ids=['horizontal', 'vertical'])
@pytest.mark.parametrize('contact', GOLDEN)
def test_filter_gives_the_golden_values(steps: list[list[Step]], contact: int, plane: int) -> None:
    """Mode probability to 1e-6, mixture to 1 cm and 1 cm/s."""
    after = steps[plane][contact - 2].updated
    probability, state = GOLDEN[contact][1 + plane]
    assert_allclose(after.mode_probability[0, 1], probability, rtol=0.0, atol=1e-6)
    assert_allclose(after.moments()[0][0], state, rtol=0.0, atol=0.01)


def test_two_point_start_is_the_one_of_the_tracker(measured) -> None:
    """The study starts its tracks as `initiation.two_point` does."""
    old, new = (
        Seeds(
            time=np.array([k * PERIOD]),
            position=measured.position[k],
            covariance=measured.covariance[k],
            free=np.ones(1),
            clutter_volume=np.ones(1),
            relief=np.ones(1),
        )
        for k in (0, 1)
    )
    starts = two_point(
        old, new, Density(1e-12, 1e-12), Coverage(PERIOD, PERIOD), PERIOD, 0.9, 0.0,
        InitiationConfig(),
    )  # fmt: skip
    for plane, mixture in zip(
        paper_planes(), two_point_start(paper_planes(), measured, PERIOD), strict=True
    ):
        mean, covariance = plane_start(starts, plane.coordinates)
        assert_allclose(mixture.mean[0, 1], mean[0], rtol=1e-12)
        assert_allclose(mixture.covariance[0, 1], covariance[0], rtol=1e-12)


@pytest.mark.parametrize('claim', CLAIMS, ids=[claim.name for claim in CLAIMS])
def test_figures_are_as_expected(values: Figures, claim: Claim) -> None:
    """Every figure of the study is inside its limits at 500 runs."""
    assert claim.holds(values[claim.name]), f'{values[claim.name]:.4g}, not {claim.limits}'


def test_figures_first_contact_is_worse_than_the_plots(values: Figures) -> None:
    """At the first contact of a manoeuvre the filter loses against the plots on every axis."""
    assert all(values[f'{output} first contact {axis}'] > 1.0
               for output in ('map', 'mmse') for axis in 'xyz')  # fmt: skip
