# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is expected of a scan before its plots are shared."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.sensor import Sonar
from tracking_core.batches import Coverage, Scan
from tracking_core.clutter import Clutter
from tracking_core.clutter_map import ClutterMap, SPOKES
from tracking_core.density import Density, expected_density
from tracking_core.space import ANGLES

SONAR, VOLUME = Sonar(SonarTrackerConfig().sensor), 2.0 * np.pi
BLANK = ClutterMap.blank(ANGLES)
COUNT = np.zeros((SPOKES, 1))
COUNT[:8] = 20.0  # plots in the first eighth of the turn, in ten looks
UNEVEN = ClutterMap(COUNT, np.full((SPOKES, 1), 10.0))


def scan_of(bearing: list[float]) -> Scan:
    """Return bearings heard all around."""
    M = len(bearing)
    return Scan(
        time=np.zeros(M), position=np.array(bearing)[:, None], covariance=np.ones((M, 1, 1)),
        range_rate=np.full(M, np.nan), range_rate_variance=np.ones(M), snr=np.full(M, np.nan),
        clutter_volume=np.ones(M), sensor_position=np.zeros((M, 3)),
        sensor_velocity=np.zeros((M, 3)), coverage=Coverage(0.0, 0.0), volume=VOLUME,
    )  # fmt: skip


def expected(clutter: Clutter, told: float = 0.0) -> Density:
    """Return what is expected of three plots, with half a new contact in all."""
    return expected_density(clutter, told, 0.5, scan_of([0.4, 3.0, 4.0]), SONAR, 7.0)


@pytest.mark.parametrize(
    ('clutter', 'told', 'mean'),
    [
        (Clutter(BLANK), 0.0, 3.0 / VOLUME),  # nothing known: the plots themselves
        (Clutter(BLANK, 0.8, 5.0), 0.0, 0.8),
        (Clutter(UNEVEN, 0.8, 5.0), 0.3, 0.3),  # what is told goes before what is learnt
    ],
    ids=['first', 'learnt', 'told'],
)
def test_expected_density_is_told_or_learnt_or_that_of_the_first_plots(
    clutter: Clutter, told: float, mean: float
) -> None:
    """Without a pattern."""
    found = expected(clutter, told)
    assert found.clutter == pytest.approx(mean)
    assert found.new_contacts == pytest.approx(0.5 / VOLUME)
    assert (found.leniency, found.pattern) == (7.0, None)
    assert found.at_plots.tolist() == [1.0, 1.0, 1.0]


def test_expected_density_has_the_pattern_of_an_uneven_map() -> None:
    """At the plots and anywhere: dense in the eighth that had all of them, thin elsewhere."""
    found = expected(Clutter(UNEVEN, 16.0 / VOLUME, 10.0))
    assert found.at_plots[0] > 4.0
    assert (found.at_plots[1:] < 0.5).all()
    assert_allclose(found.relief(np.array([[0.4], [3.0]])), found.at_plots[:2])
    assert_allclose(found.turns_of_clutter(np.pi / 8.0), 0.5)


def test_density_without_leniency_is_as_usual() -> None:
    """Tentative tracks must be as likely as parameters say."""
    assert Density(1.0, 1.0).leniency == 1.0
