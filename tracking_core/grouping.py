# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which tracks may be too near each other for plots of their own?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import minimum_spanning_tree

from tracking_core.association.clusters import clusters
from tracking_core.association.partitions import Partitions
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.rows import take

LARGEST = 5  # tracks that may have one plot in common


@dataclass(frozen=True)
class Groups:
    """Partitions of the tracks; units 0 to T - 1 are the tracks, the sets of tracks follow."""

    partitions: Partitions
    unit: Ints  # (N,) sets of tracks, ascending from T; row n says that it has ...
    member: Ints  # (N,) ... this track
    existence_apart: Floats  # (T,) chance to exist of a track that is one with nobody


@dataclass(frozen=True)
class Links:
    """Pairs of tracks that may be one."""

    first: Ints  # (L,) ascending
    second: Ints  # (L,) above `first`
    chance: Floats  # (L,) that they are, if both exist, in (0, 1)


def group_tracks(links: Links, existence: Floats) -> Groups:
    """
    Return all ways in which tracks may be one, with their chances.

    Neighbours are one or not independently; who the neighbours are says the spanning tree of the
    greatest chances. In one coordinate that is the order of the tracks.

    Parameters
    ----------
    links : Links
        Who may be one with whom.
    existence : (T,) array
        Chance of each track to exist.

    """
    T = len(existence)
    links, label = _neighbours(links, T)
    both = links.chance * existence[links.first] * existence[links.second]
    sizes = np.bincount(label)
    parts = [_alone(np.flatnonzero(sizes[label] == 1), label)]
    for size in np.unique(sizes[sizes > 1]):
        mine = sizes[label[links.first]] == size
        parts.append(
            _together(int(size), links.first[mine], links.second[mine], both[mine], label)
        )
    return _joined(parts, _existence_apart(links, existence))


def _existence_apart(links: Links, existence: Floats) -> Floats:
    """
    Return the chance (T,) that a track exists, given that it is one with none of its neighbours.

    By Bayes, each neighbour on its own: those that are not one with a near neighbour are the less
    likely to exist the surer existing ones would be.
    """
    apart = existence.copy()
    for one, other in ((links.first, links.second), (links.second, links.first)):
        np.multiply.at(apart, one, 1.0 - links.chance * existence[other])
    return np.asarray(apart / (apart + 1.0 - existence))


def _neighbours(links: Links, tracks: int) -> tuple[Links, Ints]:
    """
    Keep a spanning tree of the greatest chances, and of that no component above `LARGEST`.

    Returns the links and the component of each track.
    """
    label = _components(links, tracks)
    if len(links.first) > tracks - 1 - label.max(initial=-1):  # there are loops
        links = _spanning_tree(links, tracks)
    while True:
        large = (np.bincount(label) > LARGEST)[label[links.first]]
        if not large.any():
            return links, label
        least = np.full(label.max() + 1, np.inf)
        np.minimum.at(least, label[links.first], links.chance)
        links = take(links, ~large | (links.chance > least[label[links.first]]))
        label = _components(links, tracks)


def _spanning_tree(links: Links, tracks: int) -> Links:
    start = links.first.searchsorted(np.arange(tracks + 1)).astype(np.int32)  # for scipy 1.11
    by_row = (1.0 - np.log(links.chance), links.second.astype(np.int32), start)
    tree = minimum_spanning_tree(csr_array(by_row, shape=(tracks, tracks)))
    first = np.arange(tracks).repeat(np.diff(tree.indptr))
    return Links(first, tree.indices.astype(np.int64), np.exp(1.0 - tree.data))


def _components(links: Links, tracks: int) -> Ints:
    """Return the component of each track: a link is like a plot in two gates."""
    link = np.arange(len(links.first))
    track, plot = np.concatenate([links.first, links.second]), np.concatenate([link, link])
    return clusters(track, plot, tracks, len(link))[0]


@dataclass(frozen=True)
class _Part:
    """Partitions of groups of one size; a set of tracks is a row of members and its bit mask."""

    group: Ints  # (S,)
    log_chance: Floats  # (S,)
    partition: Ints  # (N,) of this part
    members: Ints  # (N, size)
    mask: Ints  # (N,)


def _alone(track: Ints, label: Ints) -> _Part:
    row = np.arange(len(track))
    return _Part(label[track], np.zeros(len(track)), row, track[:, None], np.ones_like(row))


def _together(size: int, first: Ints, second: Ints, chance: Floats, label: Ints) -> _Part:
    """Return all partitions of C groups of a size: each of its links holds or does not."""
    links = size - 1
    order = np.argsort(label[first], kind='stable')
    first, second = first[order].reshape(-1, links), second[order].reshape(-1, links)
    chance = chance[order].reshape(-1, links)
    nodes = np.sort(np.concatenate([first, second], axis=1), axis=1)
    fresh = np.diff(nodes, axis=1, prepend=-1) > 0
    nodes = nodes[fresh].reshape(-1, size)
    C, S = len(nodes), 1 << links
    holds = np.arange(S)[:, None] >> np.arange(links) & 1 == 1  # (S, links)
    near = np.zeros((C, S, size, size), bool)
    near[..., np.arange(size), np.arange(size)] = True
    group, at = np.arange(C)[:, None], np.arange(S)
    for k in range(links):
        a = (nodes == first[:, k, None]).argmax(axis=1)[:, None]
        b = (nodes == second[:, k, None]).argmax(axis=1)[:, None]
        near[group, at, a, b] |= holds[:, k]
        near[group, at, b, a] |= holds[:, k]
    for _ in range((links - 1).bit_length()):  # each doubles how far one hears of another
        near = np.asarray((near[..., :, :, None] & near[..., None, :, :]).any(axis=-2))
    mask = (near << np.arange(size)).sum(axis=-1)  # (C, S, size): with whom each one is one
    leader = near.argmax(axis=-1) == np.arange(size)
    log_chance = np.where(holds, np.log(chance)[:, None], np.log1p(-chance)[:, None]).sum(axis=-1)
    c, s, _ = np.nonzero(leader)
    return _Part(
        np.repeat(label[nodes[:, 0]], S), log_chance.reshape(-1), c * S + s, nodes[c],
        mask[leader],
    )  # fmt: skip


def _joined(parts: list[_Part], existence_apart: Floats) -> Groups:
    """Return the parts as one: sets of more than one track are numbered behind the tracks."""
    sets: list[tuple[Ints, Ints]] = []
    units, number = [], len(existence_apart)
    groups = np.concatenate([part.group for part in parts])
    for part in parts:
        size = part.members.shape[1]
        is_set = _bits(part.mask, size).sum(axis=1) > 1
        unit = part.members[np.arange(len(part.mask)), np.log2(part.mask & -part.mask).astype(int)]
        key = part.members[:, 0] << size | part.mask
        _, one, place = np.unique(key[is_set], return_index=True, return_inverse=True)
        unit[is_set] = number + place.reshape(-1)
        rows = np.flatnonzero(is_set)[one]
        row, bit = np.nonzero(_bits(part.mask[rows], size))
        sets.append((number + row, part.members[rows[row], bit]))
        units.append(unit)
        number += len(rows)
    order = np.argsort(groups, kind='stable')
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    base = np.cumsum([0] + [len(part.group) for part in parts])
    partition = rank[
        np.concatenate([p.partition + b for p, b in zip(parts, base[:-1], strict=True)])
    ]
    unit, by = np.concatenate(units), np.argsort(partition, kind='stable')
    unit_group = np.empty(number, np.int64)
    unit_group[unit[by]] = groups[order][partition[by]]
    log_chance = np.concatenate([part.log_chance for part in parts])[order]
    return Groups(
        Partitions(groups[order], log_chance, partition[by], unit[by], unit_group),
        np.concatenate([s[0] for s in sets]),
        np.concatenate([s[1] for s in sets]),
        existence_apart,
    )


def _bits(mask: Ints, size: int) -> Bools:
    return np.asarray(mask[:, None] >> np.arange(size) & 1 == 1)
