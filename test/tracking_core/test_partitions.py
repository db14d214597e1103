# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Joint events in which a plot may belong to several tracks, against full enumeration."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.association.partitions import over_partitions
from tracking_core.unresolved.grouping import group_tracks, Groups, LARGEST, Links


def sets_of(links, held, tracks):
    """Return the sets of tracks that are one when these links hold."""
    sets = [{t} for t in range(tracks)]
    for (a, b), holds in zip(links, held, strict=True):
        if holds:
            one = next(s for s in sets if a in s)
            other = next(s for s in sets if b in s)
            if one is not other:
                sets.remove(other)
                one |= other
    return [frozenset(s) for s in sets]


def enumerate_events(tracks, plots, links, chance, log_weight, log_miss):
    """Return the probability of each (set of tracks, plot), over all links and assignments."""
    total, having = 0.0, {}
    for held in product([False, True], repeat=len(links)):
        prior = np.prod([p if h else 1.0 - p for p, h in zip(chance, held, strict=True)])
        units = sets_of(links, held, tracks)
        for plan in product(range(-1, plots), repeat=len(units)):
            taken = [j for j in plan if j >= 0]
            if len(set(taken)) < len(taken):
                continue
            weight = prior
            for unit, j in zip(units, plan, strict=True):
                weight *= np.exp(log_miss[unit] if j < 0 else log_weight.get((unit, j), -np.inf))
            total += weight
            for unit, j in zip(units, plan, strict=True):
                if j >= 0:
                    having[unit, j] = having.get((unit, j), 0.0) + weight
    return {key: value / total for key, value in having.items()}


def units_of(groups: Groups, tracks: int) -> list[frozenset[int]]:
    """Return the set of tracks that each unit stands for."""
    count = len(groups.partitions.unit_group)
    sets = [{t} for t in range(tracks)] + [set() for _ in range(count - tracks)]
    for unit, member in zip(groups.unit, groups.member, strict=True):
        sets[unit].add(int(member))
    return [frozenset(s) for s in sets]


CASES = {
    'a pair': (2, 2, [(0, 1)]),
    'a pair and a stranger': (3, 3, [(0, 1)]),
    'a chain': (4, 3, [(0, 1), (1, 2), (2, 3)]),
    'a star': (4, 3, [(0, 1), (1, 2), (1, 3)]),
    'two pairs': (4, 3, [(0, 2), (1, 3)]),
    'more plots than tracks': (3, 5, [(1, 2)]),
    'no plots': (2, 0, [(0, 1)]),
    'nobody near': (3, 3, []),
}


@pytest.mark.parametrize('seed', range(3))
@pytest.mark.parametrize('case', CASES)
def test_over_partitions_equals_enumeration(case: str, seed: int) -> None:
    """The probability of every unit and plot, to 1e-9."""
    tracks, plots, links = CASES[case]
    rng = np.random.default_rng(seed)
    chance = rng.uniform(0.05, 0.95, len(links))
    first, second = np.array(links, np.int64).reshape(-1, 2).T
    groups = group_tracks(Links(first, second, chance), np.ones(tracks))
    units = units_of(groups, tracks)
    log_weight = {
        (unit, j): rng.normal(1.0, 3.0)
        for unit in units for j in range(plots) if rng.random() < 0.8
    }  # fmt: skip
    log_miss = {unit: -rng.exponential(2.0) for unit in units}
    every = product(range(len(units)), range(plots))
    pairs = [(u, j) for u, j in every if (units[u], j) in log_weight]
    unit, plot = np.array(pairs, np.int64).reshape(-1, 2).T
    weight = np.array([log_weight[units[u], j] for u, j in pairs])
    probability, rough = over_partitions(
        unit, plot, weight, np.array([log_miss[u] for u in units]), plots, groups.partitions
    )
    expected = enumerate_events(tracks, plots, links, chance, log_weight, log_miss)
    assert not rough.any()
    assert_allclose(probability, [expected.get((units[u], j), 0.0) for u, j in pairs], atol=1e-9)


def test_over_partitions_of_a_crowd_is_flagged() -> None:
    """Many groups that all compete are worked on one by one, and say so."""
    first = np.arange(0, 40, 2)
    groups = group_tracks(Links(first, first + 1, np.full(20, 0.5)), np.ones(40))
    unit = np.repeat(np.arange(60), 2)
    plot = np.tile([0, 1], 60)
    probability, rough = over_partitions(
        unit, plot, np.zeros(120), np.full(60, -1.0), 2, groups.partitions
    )
    assert rough.all()
    assert np.isfinite(probability).all()


def test_group_tracks_has_every_partition_of_a_chain() -> None:
    """Three in a row: apart, two of them, or all; never the outer ones without the middle one."""
    groups = group_tracks(
        Links(np.array([0, 1]), np.array([1, 2]), np.array([0.6, 0.3])), np.ones(3)
    )
    assert set(units_of(groups, 3)) == {frozenset(s) for s in ((0,), (1,), (2,), (0, 1), (1, 2),
                                                               (0, 1, 2))}  # fmt: skip
    chances = np.sort(np.exp(groups.partitions.log_chance))
    assert_allclose(chances, np.sort([0.4 * 0.7, 0.6 * 0.7, 0.4 * 0.3, 0.6 * 0.3]), rtol=1e-12)


def test_group_tracks_drops_the_weakest_links_of_a_crowd() -> None:
    """No group is larger than the limit, and chances of every group sum to 1."""
    rng = np.random.default_rng(2)
    first = np.arange(29)
    groups = group_tracks(Links(first, first + 1, rng.uniform(0.1, 0.9, 29)), np.ones(30))
    sizes = np.bincount(groups.partitions.unit_group[:30])
    assert sizes.max() == LARGEST
    total = np.bincount(groups.partitions.group, np.exp(groups.partitions.log_chance))
    assert_allclose(total, 1.0, rtol=1e-12)


def test_group_tracks_keeps_a_tree_of_the_greatest_chances() -> None:
    """Three that are all near each other: the least link is left out."""
    links = Links(np.array([0, 0, 1]), np.array([1, 2, 2]), np.array([0.9, 0.2, 0.8]))
    groups = group_tracks(links, np.ones(3))
    assert frozenset((0, 2)) not in units_of(groups, 3)


def test_group_tracks_knows_what_being_apart_tells() -> None:
    """Of a sure contact and a doubtful one: enumerated over existence and being one."""
    r, chance = np.array([0.95, 0.6]), 0.8
    groups = group_tracks(Links(np.zeros(1, int), np.ones(1, int), np.array([chance])), r)
    together = chance * r.prod()
    assert_allclose(np.sort(np.exp(groups.partitions.log_chance)),
                    np.sort([together, 1.0 - together]))  # fmt: skip
    assert_allclose(groups.existence_apart, (r - together) / (1.0 - together), rtol=1e-12)
