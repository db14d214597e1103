# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""In which ways may the members of groups be one with each other? All of them, enumerated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.partitions import Partitions
from tracking_core.batches import Bools, Floats, Ints


@dataclass(frozen=True)
class Ways:
    """Partitions of groups of one size; a set of tracks is a row of members and its bit mask."""

    group: Ints  # (S,)
    log_chance: Floats  # (S,)
    partition: Ints  # (N,) of this part
    members: Ints  # (N, size)
    mask: Ints  # (N,)


def alone(track: Ints, label: Ints) -> Ways:
    """Return the one way in which tracks can be that are linked with nobody."""
    row = np.arange(len(track))
    return Ways(label[track], np.zeros(len(track)), row, track[:, None], np.ones_like(row))


def together(size: int, first: Ints, second: Ints, chance: Floats, label: Ints) -> Ways:
    """Return all partitions of C groups of a size: each of its links holds or does not."""
    links = size - 1
    order = np.argsort(label[first], kind='stable')
    first, second = first[order].reshape(-1, links), second[order].reshape(-1, links)
    chance = chance[order].reshape(-1, links)
    nodes = np.sort(np.concatenate([first, second], axis=1), axis=1)
    nodes = nodes[np.diff(nodes, axis=1, prepend=-1) > 0].reshape(-1, size)
    S = 1 << links
    holds = np.arange(S)[:, None] >> np.arange(links) & 1 == 1  # (S, links)
    one = _all_one(nodes, first, second, holds)
    mask = (one << np.arange(size)).sum(axis=-1)  # (C, S, size): with whom each one is one
    leader = one.argmax(axis=-1) == np.arange(size)
    log_chance = np.where(holds, np.log(chance)[:, None], np.log1p(-chance)[:, None]).sum(axis=-1)
    c, s, _ = np.nonzero(leader)
    return Ways(
        np.repeat(label[nodes[:, 0]], S), log_chance.reshape(-1), c * S + s, nodes[c],
        mask[leader],
    )  # fmt: skip


def _all_one(nodes: Ints, first: Ints, second: Ints, holds: Bools) -> Bools:
    """Return which members of each group are one (C, S, size, size), if those links hold."""
    (C, size), (S, links) = nodes.shape, holds.shape
    one = np.zeros((C, S, size, size), bool)
    one[..., np.arange(size), np.arange(size)] = True
    group, at = np.arange(C)[:, None], np.arange(S)
    for k in range(links):
        a = (nodes == first[:, k, None]).argmax(axis=1)[:, None]
        b = (nodes == second[:, k, None]).argmax(axis=1)[:, None]
        one[group, at, a, b] |= holds[:, k]
        one[group, at, b, a] |= holds[:, k]
    for _ in range((links - 1).bit_length()):  # each doubles how far one hears of another
        one = np.asarray((one[..., :, :, None] & one[..., None, :, :]).any(axis=-2))
    return one


def joined(ways: list[Ways], tracks: int) -> tuple[Partitions, Ints, Ints]:
    """
    Return the partitions of all sizes as one, and of which tracks each set is.

    Units 0 to `tracks` - 1 are the tracks; the sets of more than one are numbered behind them.
    Row n of the other two (N,) says that set `unit`[n] has the track `member`[n].
    """
    units, unit, member, number = [], [], [], tracks
    for part in ways:
        of_row, row, track = _number(part, number)
        units.append(of_row)
        unit.append(number + row)
        member.append(track)
        number += int(row.max(initial=-1)) + 1
    partitions = _by_group(ways, np.concatenate(units), number)
    return partitions, np.concatenate(unit), np.concatenate(member)


def _number(part: Ways, first: int) -> tuple[Ints, Ints, Ints]:
    """
    Return the unit of each row (N,): a track, or a set, of which each gets a number.

    Sets are numbered from `first` on; also returned: sets (K,) from 0 on and their members (K,).
    """
    size = part.members.shape[1]
    is_set = _bits(part.mask, size).sum(axis=1) > 1
    unit = part.members[np.arange(len(part.mask)), np.log2(part.mask & -part.mask).astype(int)]
    key = part.members[:, 0] << size | part.mask  # a set may be in several partitions
    _, one, place = np.unique(key[is_set], return_index=True, return_inverse=True)
    unit[is_set] = first + place.reshape(-1)
    rows = np.flatnonzero(is_set)[one]
    row, bit = np.nonzero(_bits(part.mask[rows], size))
    return unit, row, part.members[rows[row], bit]


def _by_group(ways: list[Ways], unit: Ints, units: int) -> Partitions:
    """Return the partitions of all parts and their units (N,), in the order of the groups."""
    groups = np.concatenate([part.group for part in ways])
    log_chance = np.concatenate([part.log_chance for part in ways])
    order = np.argsort(groups, kind='stable')
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    base = np.cumsum([0] + [len(part.group) for part in ways])
    rows = [part.partition + begin for part, begin in zip(ways, base[:-1], strict=True)]
    partition = rank[np.concatenate(rows)]
    by = np.argsort(partition, kind='stable')
    unit_group = np.empty(units, np.int64)
    unit_group[unit[by]] = groups[order][partition[by]]
    return Partitions(groups[order], log_chance[order], partition[by], unit[by], unit_group)


def _bits(mask: Ints, size: int) -> Bools:
    return np.asarray(mask[:, None] >> np.arange(size) & 1 == 1)
