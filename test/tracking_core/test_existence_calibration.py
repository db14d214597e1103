# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A track that is called 0.9 likely is real in nine cases of ten, in simulation."""

from __future__ import annotations

from itertools import pairwise

import pytest

from benchmarks.existence_calibration import CASES, EDGES, play, Rows


@pytest.fixture(scope='module', params=[CASES[0], CASES[1]], ids=lambda case: case.name)
def rows(request) -> Rows:
    """Births, deaths, misses and false plots as the parameters say; 20 scenes of 40 looks."""
    return play(request.param, scenes=20, looks=40, seed=1)


def test_existence_of_nine_in_ten_is_true(rows: Rows) -> None:
    """Of the rows called 0.85 to 0.95 likely, 0.85 to 0.95 are real."""
    share, count = rows.share(0.85, 0.95)
    assert count > 100
    assert 0.85 <= share <= 0.95


def test_existence_is_reliable_everywhere(rows: Rows) -> None:
    """Each bin with enough rows holds about the share of real tracks that it says."""
    checked = 0
    for low, high in pairwise(EDGES):
        share, count = rows.share(low, high)
        if count >= 80:
            assert low - 0.1 <= share <= high + 0.1, f'{low} to {high}: {share:.3f}'
            checked += 1
    assert checked >= 5
