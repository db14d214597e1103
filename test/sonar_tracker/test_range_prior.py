# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far off a new contact is taken to be."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from sonar_tracker.build import build_estimator
from sonar_tracker.config import SonarTrackerConfig
from tracking_core.config import with_values
from tracking_core.estimators import ModifiedPolar


def polar(prior: str, nearest: float, farthest: float) -> ModifiedPolar:
    """Return the filter for contacts between these ranges [m]."""
    values = {
        'estimator': 'modified_polar', 'ranging.enabled': False, 'motion.range_prior': prior,
        'motion.range_min': nearest, 'motion.range_max': farthest,
    }  # fmt: skip
    found = build_estimator(with_values(SonarTrackerConfig(), values))
    assert isinstance(found, ModifiedPolar)
    return found


@pytest.mark.parametrize(('nearest', 'farthest'), [(300.0, 12_000.0), (5_000.0, 8_000.0)])
def test_prior_is_that_of_places_or_of_inverse_ranges(nearest: float, farthest: float) -> None:
    """Mean and sd of 1 over range are those of a million contacts."""
    rng = np.random.default_rng(1)
    drawn = {
        'sea': rng.uniform(nearest**2, farthest**2, 1_000_000) ** -0.5,
        'inverse': rng.uniform(1.0 / farthest, 1.0 / nearest, 1_000_000),
    }
    for prior, inverse_range in drawn.items():
        found = polar(prior, nearest, farthest)
        assert_allclose(found.inverse_range, inverse_range.mean(), rtol=1e-2)
        assert_allclose(found.inverse_range_sd, inverse_range.std(), rtol=1e-2)


def test_new_contacts_may_be_at_one_range() -> None:
    """Limits that are all but equal leave a prior that is not singular."""
    found = polar('sea', 5e3, 5e3 + 1e-9)
    assert_allclose(found.inverse_range_sd, 1e-3 * found.inverse_range, rtol=1e-3)
