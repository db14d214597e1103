# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if two contacts may have one plot in common? Joint events over partitions of the tracks.

Tracks that may be unresolved form a *group*. A *partition* says who of the group is one with
whom; every set of tracks that are one is a *unit* with plots of its own, and a track alone is a
unit too. Given a partition the units compete for plots like tracks, so each combination of
partitions in a cluster is a *copy* of the cluster, with its weight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.clusters import clusters, Contest, renumber
from tracking_core.association.exact import marginalise_and_sum
from tracking_core.batches import Bools, Floats, Ints

LARGEST = 10  # units, or plots if fewer, that a cluster may have
MOST_COPIES = 256  # of a cluster


@dataclass(frozen=True)
class Partitions:
    """Who may be one with whom. Groups without an alternative have one partition."""

    group: Ints  # (S,) of each partition, ascending from 0 without a gap
    log_chance: Floats  # (S,)
    partition: Ints  # (N,) ascending; row n says that it has ...
    unit: Ints  # (N,) ... this unit
    unit_group: Ints  # (U,)

    @property
    def sizes(self) -> Ints:
        """Number of partitions of each group."""
        return np.bincount(self.group)


def over_partitions(
    unit: Ints,
    plot: Ints,
    log_weight: Floats,
    log_miss: Floats,
    plots: int,
    partitions: Partitions,
) -> tuple[Floats, Bools]:
    """
    Share the plots among units that exist in some partitions only.

    Parameters
    ----------
    unit, plot : (P,) arrays of int
        Gated pairs, each once, sorted by unit.
    log_weight : (P,) array
        The plot is the unit's, against clutter.
    log_miss : (U,) array
        The scan has no plot of the unit, finite.
    plots : int
        Number of plots M of the scan.
    partitions : Partitions
        Of the tracks in groups.

    Returns
    -------
    probability : (P,) array
        That the unit exists and that the plot is its.
    approximate : (groups,) array
        Clusters too large to be exact: their groups do not know of each other's plots.

    """
    label, rough = _clusters(unit, plot, plots, partitions)
    copies = _copy(label, partitions)
    row, pair = _expand(copies.unit, unit, len(log_miss))
    probability, log_sum = _solve(
        row, plot[pair], (log_weight - log_miss[unit])[pair], copies.copy, plots
    )
    log_sum = log_sum + copies.log_chance
    np.add.at(log_sum, copies.copy, log_miss[copies.unit])
    share = _normalise(log_sum, copies.cluster)
    total = np.bincount(pair, probability * share[copies.copy[row]], len(unit))
    return np.asarray(total, np.float64), rough


def has_alternatives(unit: Ints, plot: Ints, plots: int, partitions: Partitions) -> Bools:
    """Return (U,) whether a unit is in a cluster with more than one way to part its tracks."""
    label, _ = _label(unit, plot, plots, partitions)
    several = np.bincount(label, partitions.sizes > 1) > 0.0
    return np.asarray(several[label][partitions.unit_group])


@dataclass(frozen=True)
class _Copies:
    """Every combination of partitions of every cluster."""

    cluster: Ints  # (C,) of each copy
    log_chance: Floats  # (C,)
    copy: Ints  # (R,) row r says that it has ...
    unit: Ints  # (R,) ... this unit


def _clusters(unit: Ints, plot: Ints, plots: int, partitions: Partitions) -> tuple[Ints, Bools]:
    """Return the cluster of each group, and which groups stand alone although they compete."""
    label, group = _label(unit, plot, plots, partitions)
    groups = len(partitions.sizes)
    number = np.bincount(label, np.log(partitions.sizes))
    units = np.bincount(label[partitions.unit_group])
    pairs = np.unique(label[group] * plots + plot) // max(plots, 1)
    heard = np.bincount(pairs, minlength=len(units))
    large = (number > np.log(MOST_COPIES) + 1e-9) | (np.minimum(units, heard) > LARGEST)
    rough = large[label]
    # Groups of a cluster that is too large become clusters of their own.
    label = np.where(rough, label.max(initial=0) + 1 + np.arange(groups), label)
    return np.unique(label, return_inverse=True)[1].reshape(groups), rough


def _label(unit: Ints, plot: Ints, plots: int, partitions: Partitions) -> tuple[Ints, Ints]:
    """Return the cluster of each group by the plots that they share, and each pair's group."""
    group = partitions.unit_group[unit]
    order = np.argsort(group, kind='stable')
    return clusters(group[order], plot[order], len(partitions.sizes), plots)[0], group


def _copy(label: Ints, partitions: Partitions) -> _Copies:
    sizes = partitions.sizes
    order = np.argsort(label, kind='stable')
    log_size = np.log(sizes[order])
    before = np.cumsum(log_size) - log_size
    first = np.flatnonzero(np.diff(label[order], prepend=-1))
    stride = np.empty(len(sizes))
    stride[order] = np.exp(before - before[first][label[order]])
    count = np.ones(label.max(initial=-1) + 1, np.int64)
    np.multiply.at(count, label, sizes)
    base = np.cumsum(count) - count

    group = np.repeat(np.arange(len(sizes)), count[label])
    into = np.arange(len(group)) - np.repeat(np.cumsum(count[label]) - count[label], count[label])
    start = np.cumsum(sizes) - sizes
    chosen = start[group] + into // np.rint(stride).astype(np.int64)[group] % sizes[group]
    copy = base[label[group]] + into
    log_chance = np.zeros(count.sum())
    np.add.at(log_chance, copy, partitions.log_chance[chosen])
    row, member = _expand(chosen, partitions.partition, len(partitions.group))
    return _Copies(
        np.repeat(np.arange(len(count)), count), log_chance, copy[row], partitions.unit[member]
    )


def _expand(wanted: Ints, owner: Ints, owners: int) -> tuple[Ints, Ints]:
    """Return all (row of wanted, row of owner) with the same owner; `owner` ascends."""
    count = np.bincount(owner, minlength=owners)
    first = np.cumsum(count) - count
    times = count[wanted]
    row = np.repeat(np.arange(len(wanted)), times)
    return row, np.arange(len(row)) + np.repeat(first[wanted] - np.cumsum(times) + times, times)


def _solve(row: Ints, plot: Ints, gain: Floats, copy: Ints, plots: int) -> tuple[Floats, Floats]:
    """Return the probability of each pair in its copy, and the log sum of each copy's events."""
    total = np.zeros(int(copy.max()) + 1)
    if len(row) == 0:
        return np.zeros(0), total
    rows, track = renumber(row, len(copy))
    some, cluster = renumber(copy[row], len(total))
    columns, column = np.unique(cluster * plots + plot, return_inverse=True)
    contest = Contest(track, column.reshape(-1), gain, cluster, len(rows), len(columns))
    probability, total[some] = marginalise_and_sum(contest)
    return probability, total


def _normalise(log_weight: Floats, cluster: Ints) -> Floats:
    top = np.full(int(cluster.max()) + 1, -np.inf)
    np.maximum.at(top, cluster, log_weight)
    weight = np.exp(log_weight - top[cluster])
    return np.asarray(weight / np.bincount(cluster, weight)[cluster])
