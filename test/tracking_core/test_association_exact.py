# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The fast marginals against plain enumeration of all joint events."""

from __future__ import annotations

from collections.abc import Callable
import sys

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest
from scipy.linalg import block_diag

from tracking_core.association import (
    Associator,
    events,
    exact,
    global_nearest,
    jpda,
    jpda_star,
    permutations,
)
from tracking_core.association.belief import propagate
from tracking_core.association.clusters import Contest
from tracking_core.association.sums import log_others, others
from tracking_core.batches import Floats, Ints

Scene = tuple[Ints, Ints, Floats, Floats, int]
Events = Callable[[Scene], tuple[Floats, Ints]]


def make_scene(seed: int, tracks: int, plots: int, density: float, spread: float) -> Scene:
    """Return random gated pairs with their weights, as the arguments of an associator."""
    rng = np.random.default_rng(seed)
    track, plot = np.nonzero(rng.random((tracks, plots)) < density)
    log_weight = rng.uniform(-spread, spread, len(track))
    return track, plot, log_weight, -rng.uniform(0.0, min(spread, 700.0), tracks), plots


def make_blocks(seed: int) -> Scene:
    """Return clusters of three to seven tracks that share all plots."""
    track, plot = np.nonzero(block_diag(*(np.ones((k, k + 1)) for k in (3, 4, 7, 3, 5))))
    log_weight = np.random.default_rng(seed).uniform(-5.0, 5.0, len(track))
    return track, plot, log_weight, np.full(22, -1.0), 27


def enumerate_events(scene: Scene) -> tuple[Floats, Ints]:
    """Return log weight (N,) and pair of each track (N, T), -1 for a miss, of all joint events."""
    track, plot, log_weight, log_miss, _ = scene
    weight, used, choice = np.zeros(1), np.zeros(1, np.int64), np.zeros((1, 0), np.int64)
    for t, miss in enumerate(log_miss):
        options = [(-1, 0, miss)]
        options += [(k, 1 << int(plot[k]), log_weight[k]) for k in np.flatnonzero(track == t)]
        free = [(used & bit) == 0 for _, bit, _ in options]
        choice = np.concatenate(
            [
                np.insert(choice[f], t, k, axis=1)
                for f, (k, _, _) in zip(free, options, strict=True)
            ]
        )
        weight, used = (
            np.concatenate([weight[f] + w for f, (_, _, w) in zip(free, options, strict=True)]),
            np.concatenate([used[f] | bit for f, (_, bit, _) in zip(free, options, strict=True)]),
        )
    return weight, choice


def best_permutations(scene: Scene) -> tuple[Floats, Ints]:
    """Return of the events with the same tracks and plots in pairs only the best."""
    weight, choice = enumerate_events(scene)
    plot = np.append(scene[1], -1)
    best = {
        (tuple(row < 0), tuple(np.sort(plot[row]))): event  # the last of those has the most weight
        for event, row in sorted(enumerate(choice), key=lambda item: weight[item[0]])
    }
    kept = list(best.values())
    return weight[kept], choice[kept]


def marginals(scene: Scene, events: Events = enumerate_events) -> tuple[Floats, Floats]:
    """Return the probabilities of pairs (P,) and misses (T,) by enumeration."""
    weight, choice = events(scene)
    event = np.exp(weight - weight.max())
    event /= event.sum()
    pair, miss = np.zeros(len(scene[0])), np.zeros(len(scene[3]))
    for t in range(len(miss)):
        taken = choice[:, t] >= 0
        pair += np.bincount(choice[taken, t], event[taken], len(pair))
        miss[t] = event[~taken].sum()
    return pair, miss


def assert_exact(
    scene: Scene, associate: Associator = jpda, events: Events = enumerate_events
) -> None:
    """Check against enumeration; 1e-9 is a thousand times what rounding costs."""
    pair, miss = marginals(scene, events)
    result = associate(*scene)
    assert not result.approximate.any()
    assert_allclose(result.probability, pair, rtol=0.0, atol=1e-9)
    assert_allclose(result.miss, miss, rtol=0.0, atol=1e-9)


@pytest.fixture(params=[1, 0], ids=['written down', 'in steps'])
def few(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let small clusters be summed event by event, then in steps as larger ones are."""
    monkeypatch.setattr(events, 'MOST_COLUMNS', request.param * events.MOST_COLUMNS)


@pytest.mark.usefixtures('few')
@pytest.mark.parametrize('plots', range(1, 8))
@pytest.mark.parametrize('tracks', range(1, 6))
def test_jpda_equals_enumeration(tracks: int, plots: int) -> None:
    """Every size up to 5 x 7, dense and sparse, with ordinary and extreme weights."""
    for spread in (1.0, 20.0, 300.0, 1000.0):
        for density in (0.3, 0.6, 1.0):
            assert_exact(make_scene(tracks + 10 * plots, tracks, plots, density, spread))


@pytest.mark.parametrize(('tracks', 'plots'), [(7, 7), (8, 8), (8, 3), (3, 8)])
@pytest.mark.parametrize('spread', [3.0, 1000.0])
def test_jpda_equals_enumeration_on_large_clusters(tracks: int, plots: int, spread: float) -> None:
    """Clusters of up to 8 x 8, fully linked: 1.4 million joint events."""
    assert_exact(make_scene(5, tracks, plots, 1.0, spread))


def test_jpda_equals_enumeration_when_all_want_one_plot() -> None:
    """The winner of a plot is told even if each miss is impossible to floating point."""
    track, plot = np.arange(4), np.zeros(4, np.int64)
    assert_exact((track, plot, np.array([1000.0, 999.0, 998.5, -1000.0]), np.full(4, -700.0), 1))


def test_jpda_is_the_same_in_small_batches(monkeypatch: pytest.MonkeyPatch) -> None:
    """Splitting work for memory, or not merging small batches, changes nothing."""
    scene = make_blocks(8)
    whole = jpda(*scene)
    monkeypatch.setattr(events, 'MOST_COLUMNS', 0 * events.MOST_COLUMNS)
    monkeypatch.setattr(exact, 'MEMORY', 1)
    monkeypatch.setattr(exact, 'PADDING', 0)
    split = jpda(*scene)
    assert not whole.approximate.any()
    assert_allclose(split.probability, whole.probability, atol=1e-13)


def test_jpda_takes_a_wide_cluster() -> None:
    """Ten tracks that share 300 plots are still exact: each column of equal weights alike."""
    track, plot = np.repeat(np.arange(10), 300), np.tile(np.arange(300), 10)
    result = jpda(track, plot, np.zeros(3000), np.zeros(10), 300)
    assert not result.approximate.any()
    # Events with j pairs: C(10, j) 300! / (300 - j)!; a given pair is in j / 3000 of them.
    ways = np.cumprod([1.0] + [(10 - j) * (300 - j) / (j + 1) for j in range(10)])
    expected = (ways @ np.arange(11)) / 3000 / ways.sum()
    assert_allclose(result.probability, expected, rtol=1e-12)


def test_jpda_flags_belief_propagation_in_large_clusters_only() -> None:
    """Eleven tracks on eleven plots are approximated and flagged, ten on eleven are not."""
    assert jpda(*make_scene(1, 11, 11, 1.0, 3.0)).approximate.all()
    assert not jpda(*make_scene(1, 10, 11, 1.0, 3.0)).approximate.any()
    assert not jpda(*make_scene(1, 11, 10, 1.0, 3.0)).approximate.any()


def test_belief_propagation_is_near_on_tight_clusters() -> None:
    """It is off by 0.1 to 0.25 at worst, which is why it is not the default, and 0.02 at large."""
    errors = []
    for seed in range(100):
        scene = make_scene(seed, 5, 6, 0.8, 4.0)
        rough = jpda(*scene, largest=0)
        assert rough.approximate.any()
        errors.append(np.abs(rough.probability - jpda(*scene).probability))
    worst, mean = np.max(np.concatenate(errors)), np.mean(np.concatenate(errors))
    assert 0.01 < worst < 0.25
    assert mean < 0.03


@pytest.mark.parametrize('spread', [3.0, 1000.0])
def test_what_has_no_loops_is_exact_at_any_size(spread: float) -> None:
    """A chain of tracks, each sharing a plot with the next, needs no table."""
    track, plot = np.repeat(np.arange(7), 2), np.repeat(np.arange(8), 2)[1:-1]
    _, _, log_weight, log_miss, _ = make_scene(6, 7, 2, 1.0, spread)
    scene = (track, plot, log_weight, log_miss, 8)
    found = jpda(*scene, largest=0)
    assert not found.approximate.any()
    assert_allclose(found.probability, marginals(scene)[0], atol=1e-12)
    contest = Contest(track, plot, log_weight - log_miss[track], np.zeros(14, np.int64), 7, 8)
    assert_allclose(propagate(contest), found.probability, atol=1e-5)


def test_tracks_that_hang_on_a_large_contest_are_approximate_too() -> None:
    """What is summed up first depends on the rest: a tail on a ring of twelve says so."""
    ring = np.arange(12)
    track = np.concatenate([np.repeat(ring, 2), [12, 12, 13]])
    plot = np.concatenate([np.stack([ring, (ring + 1) % 12], axis=1).reshape(-1), [0, 12, 13]])
    found = jpda(track, plot, np.ones(27), -np.ones(14), 14)
    assert_array_equal(np.flatnonzero(~found.approximate), [13])


def test_others_do_not_cancel() -> None:
    """The sum of the others is right to the last digits beside a weight of 1e30."""
    weight, group = np.array([1e30, 3e-5, 1e25, 2.0, 5.0]), np.array([0, 0, 1, 1, 1])
    expected = [1.0 + 3e-5, 1e30, 8.0, 1e25, 1e25]
    assert_allclose(others(weight, group, 2), expected, rtol=1e-15)
    rest, total = log_others(np.log(weight), group, 2)
    assert_allclose(rest, np.log(expected), rtol=1e-14)
    assert_allclose(total, np.log([1e30, 1e25]), rtol=1e-14)


@pytest.mark.usefixtures('few')
@pytest.mark.parametrize('plots', range(1, 7))
@pytest.mark.parametrize('tracks', range(1, 6))
def test_jpda_star_equals_enumeration(tracks: int, plots: int) -> None:
    """Every size up to 5 x 6, dense and sparse, pairs that hang on by one plot among them."""
    for spread in (1.0, 20.0, 300.0, 1000.0):
        for density in (0.3, 0.6, 1.0):
            scene = make_scene(tracks + 10 * plots, tracks, plots, density, spread)
            assert_exact(scene, jpda_star, best_permutations)


def test_jpda_star_equals_enumeration_on_large_clusters() -> None:
    """Six tracks on six plots, and one plot and one track more that hang on to these."""
    track, plot, log_weight, log_miss, _ = make_scene(5, 7, 7, 1.0, 3.0)
    kept = (track < 6) & (plot < 6) | (track + plot == 6)
    scene = (track[kept], plot[kept], log_weight[kept], log_miss, 7)
    assert_exact(scene, jpda_star, best_permutations)


def test_jpda_star_keeps_neighbours_apart() -> None:
    """Two tracks that could as well trade their plots: JPDA shares them, JPDA* does not."""
    track, plot = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    scene = (track, plot, np.array([9.0, 8.9, 8.9, 9.0]), np.zeros(2), 2)
    assert_allclose(jpda(*scene).probability, [0.55, 0.45, 0.45, 0.55], atol=0.001)
    assert_allclose(jpda_star(*scene).probability, [1.0, 0.0, 0.0, 1.0], atol=0.001)


def test_jpda_star_is_jpda_where_nobody_can_trade() -> None:
    """A chain of tracks, each sharing a plot with the next, has no permutations."""
    track, plot = np.repeat(np.arange(7), 2), np.repeat(np.arange(8), 2)[1:-1]
    scene = (track, plot, np.linspace(-3.0, 3.0, 14), -np.ones(7), 8)
    assert_array_equal(jpda_star(*scene).probability, jpda(*scene).probability)


def test_jpda_star_leaves_no_loops_in_large_clusters() -> None:
    """Nine tracks on nine plots keep the best assignment and eight pairs more, and say so."""
    scene = make_scene(1, 9, 9, 1.0, 3.0)
    rough = jpda_star(*scene)
    assert rough.approximate.all()
    assert np.count_nonzero(rough.probability) == 9 + 9 - 1
    assert np.all(rough.probability[global_nearest(*scene).probability == 1.0] > 0.0)
    assert not jpda_star(*make_scene(1, 7, 8, 1.0, 3.0)).approximate.any()


def test_jpda_star_without_loops_is_near(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is left out in large clusters would on average change a probability by 0.03."""
    scenes = [make_scene(seed, 5, 6, 0.8, 4.0) for seed in range(100)]
    right = [jpda_star(*scene).probability for scene in scenes]
    monkeypatch.setattr(events, 'MOST_COLUMNS', 0 * events.MOST_COLUMNS)
    monkeypatch.setattr(sys.modules['tracking_core.association.jpda_star'], 'LARGEST', 0)
    errors = [jpda_star(*scene).probability - p for scene, p in zip(scenes, right, strict=True)]
    assert 0.01 < np.mean(np.abs(np.concatenate(errors))) < 0.035


def test_jpda_star_is_the_same_in_small_batches(monkeypatch: pytest.MonkeyPatch) -> None:
    """Splitting work for memory, or not merging small batches, changes nothing."""
    scene = make_blocks(8)
    whole = jpda_star(*scene)
    monkeypatch.setattr(events, 'MOST_COLUMNS', 0 * events.MOST_COLUMNS)
    monkeypatch.setattr(permutations, 'MEMORY', 1)
    monkeypatch.setattr(permutations, 'PADDING', 0)
    assert not whole.approximate.any()
    assert_allclose(jpda_star(*scene).probability, whole.probability, atol=1e-13)


@pytest.mark.parametrize('spread', [2.0, 30.0, 1000.0])
def test_global_nearest_is_the_best_joint_event(spread: float) -> None:
    """The assignment is the joint event with the greatest weight of all."""
    for seed in range(60):
        tracks, plots = 1 + seed % 5, 1 + seed % 6
        scene = make_scene(seed, tracks, plots, (0.3, 0.7, 1.0)[seed % 3], spread)
        weight, choice = enumerate_events(scene)
        best = choice[np.argmax(weight)]
        chosen = np.flatnonzero(global_nearest(*scene).probability)
        assert_array_equal(chosen, np.sort(best[best >= 0]))


def test_global_nearest_is_the_same_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Matching few clusters at a time changes nothing."""
    scene = make_scene(9, 80, 90, 0.02, 5.0)
    whole = global_nearest(*scene)
    module = sys.modules['tracking_core.association.global_nearest']
    monkeypatch.setattr(module, 'PART', 3)
    assert_array_equal(global_nearest(*scene).probability, whole.probability)


def test_global_nearest_leaves_a_plot_that_is_more_probably_clutter() -> None:
    """A pair that weighs less than the miss is not taken, though nobody else wants the plot."""
    zero = np.zeros(1, np.int64)
    assert global_nearest(zero, zero, np.array([-2.0]), np.array([-1.0]), 1).miss[0] == 1.0
    assert global_nearest(zero, zero, np.array([-0.5]), np.array([-1.0]), 1).miss[0] == 0.0
