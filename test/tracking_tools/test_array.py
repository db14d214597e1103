# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated line array: its beams, its noise, and marks that merge by themselves."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_tools.scenarios.array import LinearArray

ARRAY = LinearArray()
DEGREE = np.pi / 180.0


def test_pattern_has_the_beam_width_at_half_power() -> None:
    """1 ahead, one half at half the width to either side, small far off."""
    half = 0.5 * ARRAY.beam_width
    assert_allclose(ARRAY.pattern(np.array([0.0, half, -half])), [1.0, 0.5, 0.5], atol=1e-9)
    assert (ARRAY.pattern(np.linspace(4.0, 50.0, 99) * half) < 0.02).all()


def test_beams_are_even_in_the_cosine() -> None:
    """Five per width, from 10 to 170 degrees."""
    assert_allclose(np.degrees(np.arccos(ARRAY.cosines[[0, -1]])), [10.0, 170.0])
    assert_allclose(-np.diff(ARRAY.cosines), ARRAY.beam_width / 5.0, rtol=0.01)


def test_noise_has_unit_variance_and_the_covariance_of_the_pattern() -> None:
    """Over many cycles, within sampling error."""
    nobody = np.zeros((20_000, 0))
    output = ARRAY.listen(ARRAY.lobes(nobody), nobody, np.random.default_rng(1))
    assert_allclose(output.var(axis=0).mean(), 1.0, atol=0.01)
    beside = (output[:, 1:] * output[:, :-1]).mean()
    step = np.array(ARRAY.beam_width / 5.0)
    assert beside == pytest.approx(float(ARRAY.pattern(step)), abs=0.01)


def test_false_marks_are_as_rare_as_said() -> None:
    """About 0.0015 per degree and cycle."""
    nobody = np.zeros((5_000, 0))
    cycle, _, _ = ARRAY.marks(ARRAY.listen(ARRAY.lobes(nobody), nobody, np.random.default_rng(2)))
    assert len(cycle) / 5_000 / 160.0 == pytest.approx(0.0015, abs=0.0003)


def test_marks_of_one_contact_have_about_the_reported_sd() -> None:
    """Unbiased, and within a factor of two of what the array reports."""
    bearing, height = np.full((4000, 1), 1.2), np.full((4000, 1), 30.0)
    output = ARRAY.listen(ARRAY.lobes(bearing), height, np.random.default_rng(3))
    cycle, found, snr = ARRAY.marks(output)
    mine = np.abs(found - 1.2) < 2.0 * DEGREE
    assert mine.sum() == 4000
    error, told = found[mine] - 1.2, ARRAY.reported_sd(found[mine], snr[mine])
    assert abs(error.mean()) < 0.1 * told.mean()
    assert 0.5 < error.std() / told.mean() < 1.0  # the paper's formula is on the safe side
    assert len(cycle) > 0


@pytest.mark.parametrize(('apart', 'two'), [(3.0, 1.0), (1.5, 0.0)])
def test_marks_merge_below_some_two_degrees(apart: float, two: float) -> None:
    """Two contacts at broadside, 45 and 18 high: two marks at 3 degrees, one at 1.5."""
    bearing = np.tile([0.5 * np.pi, 0.5 * np.pi + apart * DEGREE], (2000, 1))
    height = np.tile([45.0, 18.0], (2000, 1))
    output = ARRAY.listen(ARRAY.lobes(bearing), height, np.random.default_rng(4))
    cycle, found, _ = ARRAY.marks(output)
    near = np.abs(found - bearing[0].mean()) < 4.0 * DEGREE
    count = np.bincount(cycle[near], minlength=2000)
    assert (count >= 2).mean() == pytest.approx(two, abs=0.1)
