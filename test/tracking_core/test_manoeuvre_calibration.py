# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A contact whose manoeuvre probability is 0.9 manoeuvres in about nine cases of ten."""

from __future__ import annotations

from itertools import pairwise

import pytest

from benchmarks.manoeuvre_calibration import CASES, EDGES, play, Rows

BY_NAME = {case.name: case for case in CASES}
OFF = 0.12  # at most, in bins of 80 rows and more


@pytest.fixture(scope='module', params=['default', 'turns to both sides'])
def rows(request: pytest.FixtureRequest) -> Rows:
    """Contacts jump between the modes as the parameters say; 6 scenes of 60 looks."""
    return play(BY_NAME[request.param], scenes=6, looks=60, seed=1)


def test_manoeuvres_are_told_as_often_as_they_are(rows: Rows) -> None:
    """On average over all contacts and looks."""
    assert rows.told.mean() == pytest.approx(rows.real.mean(), abs=0.03)


def test_manoeuvre_probability_is_reliable_everywhere(rows: Rows) -> None:
    """Each bin with enough rows holds about the share of manoeuvres that it says."""
    checked = 0
    for low, high in pairwise(EDGES):
        told, real, count = rows.between(low, high)
        if count >= 80:
            assert real == pytest.approx(told, abs=OFF), f'{low} to {high}'
            checked += 1
    assert checked >= 6
