# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What holds for every association method."""

from __future__ import annotations

from hypothesis import example, given, settings, strategies
import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from tracking_core.association import Associator, ASSOCIATORS, events, jpda, nearest, pda
from tracking_core.association.clusters import clusters
from tracking_core.batches import Floats, Ints

Scene = tuple[Ints, Ints, Floats, Floats, int]
every_method = pytest.mark.parametrize('associate', ASSOCIATORS.values(), ids=ASSOCIATORS)


def make_scene(
    seed: int, tracks: int, plots: int, density: float = 0.5, spread: float = 3.0
) -> Scene:
    """Return random gated pairs with their weights, as the arguments of an associator."""
    rng = np.random.default_rng(seed)
    track, plot = np.nonzero(rng.random((tracks, plots)) < density)
    log_weight = rng.uniform(-spread, spread, len(track))
    return track, plot, log_weight, -rng.uniform(0.0, min(spread, 700.0), tracks), plots


def assert_probabilities(associate: Associator, scene: Scene) -> None:
    """Check ranges, that each track's events sum to 1, and that exclusive plots stay so."""
    track, plot, _, log_miss, plots = scene
    result = associate(*scene)
    assert result.probability.shape == track.shape
    assert result.miss.shape == result.approximate.shape == log_miss.shape
    assert np.all(result.probability >= 0.0)
    assert np.all(result.miss >= 0.0)
    total = result.miss + np.bincount(track, result.probability, len(log_miss))
    assert_allclose(total, 1.0, rtol=0.0, atol=1e-12)
    if associate is not pda and not result.approximate.any():
        assert np.all(np.bincount(plot, result.probability, plots) <= 1.0 + 1e-12)


@every_method
@pytest.mark.parametrize('spread', [1.0, 30.0, 1000.0])
@pytest.mark.parametrize(
    ('tracks', 'plots'), [(1, 1), (2, 3), (7, 5), (30, 30), (0, 4), (4, 0), (0, 0)]
)
def test_associate_sums_to_one(
    associate: Associator, tracks: int, plots: int, spread: float
) -> None:
    """Miss and pairs of a track sum to 1, whatever the sizes and weights."""
    for density in (0.1, 0.5, 1.0):
        assert_probabilities(associate, make_scene(1, tracks, plots, density, spread))


@every_method
@settings(max_examples=60)
@given(
    seed=strategies.integers(0, 2**32 - 1),
    tracks=strategies.integers(0, 12),
    plots=strategies.integers(0, 14),
    density=strategies.floats(0.0, 1.0),
)
@example(seed=4555, tracks=11, plots=6, density=0.75)  # all events below exp(-4000)
def test_associate_survives_any_scene(
    associate: Associator, seed: int, tracks: int, plots: int, density: float
) -> None:
    """Any gating graph with any weights, equal ones too, gives probabilities."""
    spread = (0.0, 2.0, 50.0, 1000.0)[seed % 4]
    assert_probabilities(associate, make_scene(seed, tracks, plots, density, spread))


@every_method
@pytest.mark.parametrize('density', [0.1, 0.25, 0.6])
def test_associate_permutes_with_tracks_and_plots(associate: Associator, density: float) -> None:
    """Renaming tracks and plots renames the answer and changes nothing else."""
    track, plot, log_weight, log_miss, plots = make_scene(2, 9, 8, density)
    rng = np.random.default_rng(3)
    new_track, new_plot = rng.permutation(len(log_miss)), rng.permutation(plots)
    order = np.lexsort((new_plot[plot], new_track[track]))
    old = associate(track, plot, log_weight, log_miss, plots)
    new = associate(
        new_track[track][order],
        new_plot[plot][order],
        log_weight[order],
        log_miss[np.argsort(new_track)],
        plots,
    )
    assert_allclose(new.probability, old.probability[order], atol=1e-10)
    assert_allclose(new.miss[new_track], old.miss, atol=1e-10)


@every_method
@pytest.mark.parametrize('few', [1, 0], ids=['written down', 'in steps'])
def test_associate_batch_equals_its_clusters_one_by_one(
    associate: Associator, few: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Scenes far apart do not influence each other, small and large ones, however summed."""
    monkeypatch.setattr(events, 'MOST_COLUMNS', few * events.MOST_COLUMNS)
    scenes = [make_scene(seed, 1 + seed % 6, 1 + seed % 5) for seed in range(20)]
    scenes.append(make_scene(20, 12, 12))
    first_track = np.cumsum([0] + [len(scene[3]) for scene in scenes])
    first_plot = np.cumsum([0] + [scene[4] for scene in scenes])
    shifted = [
        (s[0] + a, s[1] + b, s[2], s[3])
        for s, a, b in zip(scenes, first_track[:-1], first_plot[:-1], strict=True)
    ]
    together = associate(*map(np.concatenate, zip(*shifted, strict=True)), int(first_plot[-1]))
    alone = [associate(*scene) for scene in scenes]
    assert_allclose(
        together.probability, np.concatenate([a.probability for a in alone]), atol=1e-12
    )
    assert_allclose(together.miss, np.concatenate([a.miss for a in alone]), atol=1e-12)


@every_method
def test_associate_gives_up_a_hopeless_plot(associate: Associator) -> None:
    """A pair of log weight -inf is never right."""
    one, zero = np.ones(1), np.zeros(1, np.int64)
    result = associate(zero, zero, np.array([-np.inf]), np.log(0.5 * one), 1)
    assert_array_equal(result.probability, [0.0])
    assert_array_equal(result.miss, [1.0])


@every_method
def test_associate_of_equal_plots_takes_each_track_once(associate: Associator) -> None:
    """Ties are no reason to give a track two plots or a plot two tracks."""
    track, plot = np.repeat(np.arange(3), 4), np.tile(np.arange(4), 3)
    assert_probabilities(associate, (track, plot, np.full(12, 2.0), np.full(3, -1.0), 4))
    assert_probabilities(associate, (track, np.arange(12), np.full(12, 2.0), np.full(3, -1.0), 12))


def test_pda_equals_the_textbook() -> None:
    """One track: beta_i = L_i / (1 - P_D P_G + sum of L), with L = P_D Lambda / lambda."""
    detection, gate, density = 0.9, 0.99, 1e-3
    likelihood = np.array([2e-3, 5e-4, 1e-4])
    ratio = detection * likelihood / density
    below = 1.0 - detection * gate + ratio.sum()
    log_miss = np.log([1.0 - detection * gate])
    for associate in (pda, jpda):
        result = associate(np.zeros(3, np.int64), np.arange(3), np.log(ratio), log_miss, 3)
        assert_allclose(result.probability, ratio / below, rtol=1e-13)
        assert_allclose(result.miss, (1.0 - detection * gate) / below, rtol=1e-13)


def test_pda_equals_jpda_when_no_plot_is_shared() -> None:
    """Without contested plots there is nothing joint about the association."""
    track = np.array([0, 0, 2, 3, 3, 3])
    scene = (track, np.array([5, 1, 0, 2, 3, 6]), np.linspace(-4, 4, 6), -np.arange(1.0, 6.0), 7)
    assert_array_equal(jpda(*scene).probability, pda(*scene).probability)
    assert_array_equal(jpda(*scene).miss, pda(*scene).miss)


def test_nearest_gives_the_loser_its_next_best_plot() -> None:
    """The larger weight wins plot 0; its rival turns to plot 1, and the third track misses."""
    track, plot = np.array([0, 0, 1, 2]), np.array([0, 1, 0, 1])
    result = nearest(track, plot, np.array([3.0, 1.0, 4.0, 0.0]), np.full(3, -1.0), 2)
    assert_array_equal(result.probability, [0.0, 1.0, 1.0, 0.0])
    assert_array_equal(result.miss, [0.0, 0.0, 1.0])


@pytest.mark.parametrize('seed', range(5))
def test_clusters_are_connected_components(seed: int) -> None:
    """Oracle: scipy. Chains in random order of tracks, cut here and there."""
    rng = np.random.default_rng(seed)
    T = 300
    order, plots = rng.permutation(T), rng.permutation(T)
    track, plot = np.repeat(order, 2)[:-1], np.repeat(plots, 2)[1:]  # each shares its neighbour's
    kept = rng.random(len(track)) < 0.9
    by_track = np.lexsort((plot[kept], track[kept]))
    track, plot = track[kept][by_track], plot[kept][by_track]
    links = coo_array((np.ones(len(track)), (track, T + plot)), shape=(2 * T, 2 * T))
    expected = connected_components(links, directed=False)[1][:T]
    label, pair_label = clusters(track, plot, T, T)
    first = np.unique(label, return_index=True)[1]
    assert_array_equal(first, np.sort(first))  # numbered by their first tracks, without a gap
    assert_array_equal(label[:, None] == label, expected[:, None] == expected)
    assert_array_equal(pair_label, label[track])


def test_clusters_follow_shared_plots_only() -> None:
    """0-2-1 hang together by plots 4 and 7; 3 has a plot of its own and 4 none."""
    track, plot = np.array([0, 0, 1, 2, 2, 3]), np.array([4, 5, 7, 4, 7, 6])
    label, pair_label = clusters(track, plot, 5, 8)
    assert_array_equal(label, [0, 0, 0, 1, 2])
    assert_array_equal(pair_label, [0, 0, 0, 0, 0, 1])
    label, pair_label = clusters(track[:2], plot[:2], 2, 8)
    assert_array_equal(label, [0, 1])
    assert_array_equal(pair_label, [0, 0])


def test_few_events_are_few() -> None:
    """BLAS would use more threads for more, and their sums differ from run to run."""
    assert not events.have_few(np.array([3, 20, 6]), np.array([9, 2, 6])).any()
    rows = np.arange(2, 6)
    columns = events.MOST_COLUMNS[rows]
    assert events.have_few(rows, columns).all()
    assert events.have_few(columns, rows).all()
    for size in zip(rows.tolist(), columns.tolist(), strict=True):
        assert events.products(*size) <= events.MOST_PRODUCTS
