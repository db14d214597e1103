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
from tracking_core.batches import Floats, Ints
from tracking_core.rows import take
from tracking_core.unresolved.ways import alone, joined, together

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
    ways = [alone(np.flatnonzero(sizes[label] == 1), label)]
    for size in np.unique(sizes[sizes > 1]):
        mine = sizes[label[links.first]] == size
        ways.append(together(int(size), links.first[mine], links.second[mine], both[mine], label))
    return Groups(*joined(ways, T), _existence_apart(links, existence))


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
