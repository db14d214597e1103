# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Existence probability against enumeration; counting of looks; who is confirmed, who goes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from tracking_core.association import pda
from tracking_core.batches import Tracks
from tracking_core.lifecycle import (
    count_looks,
    Existence,
    existence_after,
    has_left,
    LIFECYCLES,
    MOfN,
)
from tracking_core.lifecycle_config import ErrorRatioConfig, ExistenceConfig, MOfNConfig


def make_tracks(count: int) -> Tracks:
    """Tracks of which only their looks matter."""
    zero, none = np.zeros(count), np.zeros(count, np.int64)
    return Tracks(
        id=1 + np.arange(count),
        time=zero,
        birth_time=zero,
        planes=(),
        existence_probability=np.full(count, 0.5),
        confirmed=np.zeros(count, bool),
        hits=none,
        misses=none,
        outside=none,
        history=none,
        gate_size=np.zeros((count, 2)),
        gate_volume=zero,
        nis=zero,
        doubled=np.zeros(len(zero), np.int64),
        level=zero,
    )


def after_looks(lifecycle, *looks: str) -> Tracks:
    """Tracks after their looks, `x` with a plot, `.` without; all rows are of one length."""
    tracks = make_tracks(len(looks))
    gone = np.zeros(len(looks), bool)
    for column in zip(*looks, strict=True):
        tracks = count_looks(tracks, np.array(column) == 'x', np.ones(len(looks), bool))
        confirmed, ended = lifecycle.judge(tracks, tracks.existence_probability)
        tracks = replace(tracks, confirmed=confirmed & ~gone)
        gone |= ended
    return tracks, gone


def enumerated(r: float, P_D: float, P_G: float, ratios: np.ndarray) -> tuple[float, float]:
    """
    Bayes over all hypotheses of one track and its gated plots, written out.

    Weights relative to `all plots are clutter`: no contact 1 - r; a contact without a gated plot
    r (1 - P_D P_G); a contact that made plot i: r P_D Lambda_i / lambda.
    """
    weights = {'none': 1.0 - r, 'missed': r * (1.0 - P_D * P_G)}
    weights |= {f'plot {i}': r * P_D * ratio for i, ratio in enumerate(ratios)}
    total = sum(weights.values())
    exists = total - weights['none']
    return exists / total, weights['missed'] / exists


@pytest.mark.parametrize('ratios', [[], [0.3], [5.0, 0.01], [1.0, 2.0, 40.0]])
@pytest.mark.parametrize('r', [0.01, 0.5, 0.99])
def test_existence_after_equals_enumeration(r: float, ratios: list[float]) -> None:
    """One track, none to three plots, through the same weights as the tracker's."""
    P_D, P_G, count = 0.85, 0.98, len(ratios)
    shared = pda(
        np.zeros(count, np.int64), np.arange(count), np.log(P_D * r * np.array(ratios)),
        np.log1p(-np.array([P_D * P_G * r])), count,
    )  # fmt: skip
    existence, missed = existence_after(
        np.array([r]), shared.miss, np.array([shared.probability.sum()]), np.array([P_D * P_G])
    )
    expected = enumerated(r, P_D, P_G, np.array(ratios))
    assert_allclose([existence[0], missed[0]], expected, rtol=1e-12)


def test_existence_after_outside_the_coverage_changes_nothing() -> None:
    """Where the sensor does not look, nothing is learnt."""
    existence, missed = existence_after(np.array([0.7]), np.ones(1), np.zeros(1), np.zeros(1))
    assert_allclose([existence[0], missed[0]], [0.7, 1.0])


def test_existence_prior_decays_with_the_lifetime() -> None:
    """exp(-dt / lifetime), whatever the steps."""
    lifecycle = Existence(ExistenceConfig(lifetime=100.0))
    prior = lifecycle.prior(make_tracks(3), np.array([0.0, 100.0, -5.0]))
    assert_allclose(prior, [0.5, 0.5 * np.exp(-1.0), 0.5])


def test_existence_judge_confirms_for_good_and_drops() -> None:
    """Confirmed at the upper bound and ever after, dropped below the lower one."""
    lifecycle = Existence(ExistenceConfig(confirm=0.9, drop=0.1))
    tracks = replace(make_tracks(4), confirmed=np.array([False, False, True, True]))
    confirmed, ended = lifecycle.judge(tracks, np.array([0.9, 0.89, 0.11, 0.09]))
    assert_array_equal(confirmed, [True, False, True, True])
    assert_array_equal(ended, [False, False, False, True])


def test_m_of_n_confirms_with_m_plots_in_n_looks() -> None:
    """3 of 5: not 2 of 5, not 3 in 6 looks."""
    lifecycle = MOfN(MOfNConfig(hits=3, looks=5, drop_misses=4))
    tracks, _ = after_looks(lifecycle, 'xx.x..', 'x.x...', 'x..x.x', 'x.x..x', '.xx..x')
    assert_array_equal(tracks.confirmed, [True, False, False, False, True])


def test_m_of_n_gives_up_hopeless_and_lost_tracks() -> None:
    """A tentative track after looks - hits + 1 misses in a row, a confirmed one after its own."""
    lifecycle = MOfN(MOfNConfig(hits=3, looks=5, drop_misses=4))
    _, gone = after_looks(lifecycle, 'x..x...', 'x..xx..', 'xxx....', 'xxx...x', 'xx.x...')
    assert_array_equal(gone, [True, False, True, False, False])


@pytest.mark.parametrize('looks', [1, 2, 3, 5, 60])
def test_m_of_n_decides_after_n_looks(looks: int) -> None:
    """However few and far between the plots are: confirmed by M, or given up without them."""
    every = ['x' + 29 * period for period in ('..', '.x.', '..x', '.....x', '...xxxxx', 'x')]
    rows = [(row + 99 * 'x')[:looks] for row in every]
    for hits in range(1, looks + 1):
        tracks, gone = after_looks(MOfN(MOfNConfig(hits=hits, looks=looks, drop_misses=60)), *rows)
        enough = np.array([row.count('x') >= hits for row in rows])
        assert_array_equal(gone, ~enough)
        assert_array_equal(tracks.confirmed, enough)


def test_leniency_is_for_tentative_tracks() -> None:
    """In dense clutter they may be ten times less likely; one that was confirmed may not."""
    lifecycle, existence = Existence(ExistenceConfig(drop=0.02)), np.array([0.015, 0.015, 0.0015])
    tracks = replace(make_tracks(3), confirmed=np.array([True, False, False]))
    confirmed, ended = lifecycle.judge(tracks, existence, leniency=10.0)
    assert_array_equal(ended, [True, False, True])
    assert_array_equal(confirmed, tracks.confirmed)
    assert_array_equal(lifecycle.judge(tracks, existence)[1], [True, True, True])


def test_m_of_n_knows_no_doubt() -> None:
    """Existence is 1 for counting."""
    assert_array_equal(MOfN(MOfNConfig()).prior(make_tracks(2), np.ones(2)), [1.0, 1.0])


def test_count_looks_remembers_sixty_looks() -> None:
    """Hits and misses in a row are counted; the history neither overflows nor turns negative."""
    tracks = make_tracks(2)
    for _ in range(100):
        tracks = count_looks(tracks, np.array([True, False]), np.ones(2, bool))
    assert_array_equal(tracks.hits, [100, 0])
    assert_array_equal(tracks.misses, [0, 100])
    assert_array_equal(tracks.history, [2**60 - 1, 0])
    tracks = count_looks(tracks, np.array([False, True]), np.ones(2, bool))
    assert_array_equal(tracks.misses, [1, 0])


def test_looks_outside_are_no_misses() -> None:
    """They are counted apart, since the last plot; what the looks inside have told stays."""
    tracks = replace(make_tracks(2), history=np.array([0b110, 0b110]), misses=np.array([1, 1]))
    for _ in range(3):
        tracks = count_looks(tracks, np.zeros(2, bool), np.zeros(2, bool))
    tracks = count_looks(tracks, np.array([True, False]), np.ones(2, bool))
    assert_array_equal(tracks.hits, [1, 0])
    assert_array_equal(tracks.misses, [0, 2])
    assert_array_equal(tracks.outside, [0, 3])
    assert_array_equal(tracks.coasted, [0, 5])
    assert_array_equal(tracks.history, [0b1101, 0b1100])


def test_has_left_waits_for_some_looks_outside() -> None:
    """A track goes when it is outside the coverage and was so for so many looks."""
    tracks = replace(make_tracks(4), outside=np.array([4, 5, 5, 0]))
    outside = np.array([True, True, False, True])
    assert_array_equal(has_left(tracks, ~outside, 5), [False, True, False, False])


@pytest.mark.parametrize('name', LIFECYCLES)
def test_judge_takes_no_tracks(name: str) -> None:
    """Empty batches are legal."""
    configs = {
        'existence': ExistenceConfig(),
        'm_of_n': MOfNConfig(),
        'error_ratio': ErrorRatioConfig(),
    }
    lifecycle = LIFECYCLES[name](configs[name])
    confirmed, ended = lifecycle.judge(make_tracks(0), np.zeros(0))
    assert len(confirmed) == len(ended) == len(lifecycle.prior(make_tracks(0), np.zeros(0))) == 0
