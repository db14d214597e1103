# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The clutter density is learnt from what no track explains."""

from __future__ import annotations

import numpy as np
import pytest

from tracking_core.clutter import estimate_density

VOLUME = 2.0e5


@pytest.mark.parametrize('share', [1.0, 0.25])
@pytest.mark.parametrize('plots', [4.0, 60.0])
def test_estimate_density_converges_to_the_truth(plots: float, share: float) -> None:
    """Poisson counts of full turns or quarter sectors; the mean of the late estimates is true."""
    rng = np.random.default_rng(1)
    density, looks, late = 0.0, 0.0, []
    for k in range(4000):
        count = rng.poisson(plots * share)
        density, looks = estimate_density(density, looks, count, VOLUME, share)
        late += [density] if k > 100 else []
    assert np.mean(late) * VOLUME == pytest.approx(plots, rel=0.05)
    # Ten looks averaged exponentially: a standard deviation of sqrt(plots / 19).
    assert np.std(late) * VOLUME < 1.5 * np.sqrt(plots / 19.0)


def test_estimate_density_starts_with_the_first_look() -> None:
    """The first full look is taken as it is, the second is averaged with it."""
    density, looks = estimate_density(0.0, 0.0, 10.0, VOLUME, 1.0)
    assert (density * VOLUME, looks) == (pytest.approx(10.0), 1.0)
    density, looks = estimate_density(density, looks, 20.0, VOLUME, 1.0)
    assert (density * VOLUME, looks) == (pytest.approx(15.0), 2.0)


def test_estimate_density_never_says_never() -> None:
    """Half a false plot a look is assumed at least."""
    density, looks = 1e-3, 10.0
    for _ in range(500):
        density, looks = estimate_density(density, looks, 0.0, VOLUME, 1.0)
    assert density == pytest.approx(0.5 / VOLUME)


def test_estimate_density_follows_a_jump_at_once() -> None:
    """When the sea gets up the old average is void."""
    density, looks = 10.0 / VOLUME, 10.0
    density, looks = estimate_density(density, looks, 200.0, VOLUME, 1.0)
    assert (density * VOLUME, looks) == (pytest.approx(200.0), 1.0)


@pytest.mark.parametrize(('count', 'is_jump'), [(28.0, False), (40.0, True)])
def test_estimate_density_knows_a_jump_in_a_sector(count: float, is_jump: bool) -> None:
    """An eighth of a turn with 10 plots usually: twice that and ten more are still chance."""
    density, looks = 80.0 / VOLUME, 10.0
    density, looks = estimate_density(density, looks, count, VOLUME, 0.125)
    expected = 8.0 * count if is_jump else 80.0 + 0.0125 * (8.0 * count - 80.0)
    assert density * VOLUME == pytest.approx(expected)
    assert looks == (0.125 if is_jump else 10.0)
