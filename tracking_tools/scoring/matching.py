# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which track follows which contact?

Scan by scan the confirmed tracks are matched to the contacts, one to one, so that the distances
within the match radius sum up to the least; each track is compared with the truth at the time of
its own state.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.rows import take
from tracking_tools.scoring.coarse import plausible
from tracking_tools.scoring.records import TrackRows, Truth


@dataclass(frozen=True)
class Matches:
    """K matches of a track row and a contact, sorted by scan."""

    row: Ints  # (K,) of the track rows
    scan: Ints  # (K,)
    track: Ints  # (K,) id
    contact: Ints  # (K,) id
    distance: Floats  # (K,) [m]
    position: Floats  # (K, d) of the contact at the time of the row [m]
    velocity: Floats  # (K, d) [m/s]
    turning: Bools  # (K,)

    def __len__(self) -> int:
        return len(self.row)


def candidates(rows: TrackRows, truth: Truth, radius: float, slack: float) -> Matches:
    """
    Find all pairs of row and contact within the radius, sorted by scan.

    Parameters
    ----------
    rows : TrackRows
        What the tracker said.
    truth : Truth
        Of all contacts.
    radius : float
        Farther than this nothing belongs together [m].
    slack : float
        For so long before and after its samples a contact goes straight on [s].

    """
    found = [
        _near(rows, row, contact, radius, slack)
        for row, contact in plausible(rows, truth, radius, slack)
    ]
    if not found:
        found = [_near(rows, np.zeros(0, np.int64), truth, radius, slack)]
    joined = Matches(
        *(np.concatenate([getattr(part, name) for part in found]) for name in _FIELDS)
    )
    return take(joined, np.lexsort((joined.row, joined.scan)))


_FIELDS = ('row', 'scan', 'track', 'contact', 'distance', 'position', 'velocity', 'turning')


def _near(rows: TrackRows, row: Ints, contact: Truth, radius: float, slack: float) -> Matches:
    if len(contact.time) == 0:
        none, space = np.zeros(0, np.int64), np.zeros((0, rows.position.shape[1]))
        return Matches(none, none, none, none, np.zeros(0), space, space, np.zeros(0, bool))
    begin, end = contact.time[0] - slack, contact.time[-1] + slack
    row = row[(rows.time[row] >= begin) & (rows.time[row] <= end)]
    place = contact.at(rows.time[row])
    position = rows.beside(row, place.position)
    distance = np.linalg.norm(rows.position[row] - position, axis=1)
    near = distance <= radius
    row = row[near]
    return Matches(
        row, rows.scan[row], rows.id[row], np.full(len(row), contact.id[0]), distance[near],
        position[near], place.velocity[near], place.turning[near],
    )  # fmt: skip


def match(rows: TrackRows, truth: Truth, radius: float, slack: float = 0.0) -> Matches:
    """Match tracks and contacts one to one in every scan; parameters as for `candidates`."""
    return choose_pairs(candidates(rows, truth, radius, slack), radius)


def choose_pairs(near: Matches, radius: float) -> Matches:
    """Return the best one-to-one choice of every scan from candidates within this radius [m]."""
    edges = np.flatnonzero(np.diff(near.scan)) + 1
    chosen = [
        part[_assign(near.row[part], near.contact[part], near.distance[part], radius)]
        for part in np.split(np.arange(len(near)), edges)
    ]
    return take(near, np.concatenate(chosen))


def _assign(row: Ints, contact: Ints, distance: Floats, radius: float) -> Ints:
    """Return which pairs of one scan are the best one-to-one choice."""
    rows, i = np.unique(row, return_inverse=True)
    contacts, j = np.unique(contact, return_inverse=True)
    if len(rows) == len(row) == len(contacts):
        return np.arange(len(row))
    cost = np.zeros((len(rows), len(contacts)))
    pair = np.full(cost.shape, -1)
    # An unmatched contact costs the radius, so a match pays whatever its distance.
    cost[i, j], pair[i, j] = distance - radius, np.arange(len(row))
    chosen = pair[linear_sum_assignment(cost)]
    return np.asarray(np.sort(chosen[chosen >= 0]))
