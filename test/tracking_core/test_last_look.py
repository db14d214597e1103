# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do plots of this look and of earlier ones tell of new contacts?"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from tracking_core.batches import Coverage, Seeds
from tracking_core.density import Density
from tracking_core.initiation import Starts, two_point
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.looks import looks_since
from tracking_core.new_contacts import Odds
from tracking_core.rows import concatenate, take

INTERVAL = 4.0
STARING = Coverage(INTERVAL, INTERVAL)
LIMITS = InitiationConfig(speed_max=300.0, climb_max=20.0)


def plots(time, position) -> Seeds:
    """Make plots that no track claims."""
    position = np.asarray(position, float)
    one = np.ones(len(position))
    covariance = np.tile(400.0 * np.eye(2), (len(position), 1, 1))
    return Seeds(time * one, position, covariance, one, one, one)


def lag(position):
    """Return when in its turn of 4 s the antenna points there (K,) [s]."""
    return np.arctan2(position[:, 1], position[:, 0]) % (2.0 * np.pi) / (2.0 * np.pi) * 4.0


def start(seeds: Seeds, fresh: Seeds, density: Density, coverage=STARING, least=0.0) -> Starts:
    """Two-point starts with P_D 0.9."""
    return two_point(seeds, fresh, density, coverage, INTERVAL, 0.9, least, LIMITS)


@pytest.mark.parametrize('sectors', [8, 32, 128])
def test_two_point_starts_as_many_faint_tracks_in_sectors_as_in_a_turn(sectors: int) -> None:
    """Of 400 faint pairs around the radar 30 are followed in all, not one a sector at least."""
    grid = np.stack(np.meshgrid(np.arange(20), np.arange(20)), axis=-1).reshape(-1, 2) * 5e3
    first, second = grid - 48e3, grid - 48e3 + np.arange(400)[:, None]
    seeds, fresh = plots(lag(first), first), plots(4.0 + lag(second), second)
    density, count = Density(clutter=2e-7, new_contacts=1e-10), 0
    for sector in sectors_of_a_turn(sectors):
        seen = take(fresh, looks_since(fresh.time, fresh.position, 4.0, sector) > 0.0)
        count += len(start(seeds, seen, density, sector, 0.01).plot)
    assert count == pytest.approx(30, abs=4)


def sectors_of_a_turn(sectors: int) -> list[Coverage]:
    """Return what the sectors of the second turn of an antenna cover."""
    parts = np.linspace(0.0, 1.0, sectors + 1)
    return [
        Coverage(4.0 + 4.0 * one, 4.0 + 4.0 * other, 2.0 * np.pi * one, 2.0 * np.pi / sectors)
        for one, other in pairwise(parts)
    ]


def test_two_point_asks_only_where_the_antenna_looked() -> None:
    """First plots in other sectors have no second one yet: they do not tell of few contacts."""
    angle = np.linspace(-np.pi, np.pi, 60, endpoint=False) + 0.01
    ring = 4e4 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    seeds, fresh = plots(lag(ring), ring), plots(4.0 + lag(ring), ring)
    density = Density(1e-7, 1e-10)
    for sector in sectors_of_a_turn(8):
        here = looks_since(fresh.time, ring, 4.0, sector) > 0.0
        assert 7 <= here.sum() <= 8
        alone, among = (
            start(first, take(fresh, here), density, sector, 1e-9)
            for first in (take(seeds, here), seeds)
        )
        assert len(alone.plot) >= 7
        assert_allclose(among.existence_probability, alone.existence_probability, rtol=1e-12)


def test_two_point_asks_plots_of_the_last_look_how_many_contacts_are_new() -> None:
    """Plots left of the look before are of few contacts: those were seen again and have tracks."""
    places = np.random.default_rng(3).uniform(-5e4, 5e4, (400, 2))
    young, fresh = plots(0.0, places[:100]), plots(4.0, places[:100] + 200.0)
    left = plots(-4.0, places[100:] + 1e6)  # nothing was near them since
    density = Density(1e-8, 1e-10)
    alone = start(young, fresh, density)
    among = start(concatenate(young, left), fresh, density)
    assert_allclose(among.existence_probability, alone.existence_probability, rtol=1e-12)


@pytest.mark.parametrize(('clutter', 'kept'), [(1e-9, [True, True]), (1e-6, [True, False])])
def test_a_plot_that_was_missed_since_starts_nothing_in_dense_clutter(clutter, kept) -> None:
    """It could not be worth a track there, whatever comes: so no pairs are sought for it."""
    seeds = plots(np.array([0.0, -4.0]), np.zeros((2, 2)))
    odds = Odds(Density(clutter, 1e-10), 0.9, LIMITS)
    worth, leniency = odds.can_start(seeds, np.array([1.0, 2.0]), INTERVAL, 0.02)
    assert_array_equal(worth, kept)
    assert (leniency > 1.0) == (clutter > 1e-8)


def test_looks_since_counts_the_passes_of_the_antenna() -> None:
    """Not the messages: what lies beyond the sector was not looked at, wherever it was cut."""
    ring = 2e4 * np.array([[1.0, 0.1], [-0.1, 1.0], [-1.0, -0.1], [0.1, -1.0]])
    half, whole = Coverage(4.0, 6.0, 0.0, np.pi), Coverage(4.0, 8.0, 0.0, 2.0 * np.pi)
    assert_array_equal(looks_since(lag(ring), ring, 4.0, half), [1.0, 1.0, 0.0, 0.0])
    assert_array_equal(looks_since(lag(ring), ring, 4.0, whole), np.ones(4))
    assert_array_equal(looks_since(lag(ring) - 4.0, ring, 4.0, whole), 2.0 * np.ones(4))
    assert_array_equal(looks_since(np.array([0.0, -4.0]), ring[:2], 4.0, STARING), [1.0, 2.0])
