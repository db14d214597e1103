# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far is a set of estimates from the set of contacts? OSPA, and distances scan by scan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from tracking_core.batches import Floats, Ints
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import TrackRows
from tracking_tools.scoring.stretches import Stretches


@dataclass(frozen=True)
class OspaParts:
    """The metric, and how much of it comes from distances and from numbers [m]."""

    total: float
    localisation: float
    cardinality: float


def ospa_of_distances(distance: Floats, cutoff: float, power: float = 1.0) -> OspaParts:
    """
    Return the optimal sub-pattern assignment metric from distances.

    Parameters
    ----------
    distance : (N, M) array
        Of the estimates and the contacts [m].
    cutoff : float
        c, the distance that counts as not found [m].
    power : float
        p.

    References
    ----------
    Schuhmacher, Vo and Vo, A consistent metric for performance evaluation of multi-object filters,
    2008, eq. 3 and section II.C.

    """
    most, least = max(distance.shape), min(distance.shape)
    if most == 0:
        return OspaParts(0.0, 0.0, 0.0)
    cost = np.minimum(distance, cutoff) ** power
    near = float(cost[linear_sum_assignment(cost)].sum()) / most
    number = cutoff**power * (most - least) / most
    roots = [float(part ** (1.0 / power)) for part in (near + number, near, number)]
    return OspaParts(*roots)


def distances_of_scans(
    rows: TrackRows, near: Matches, stretches: Stretches, scans: int, cutoff: float
) -> Iterator[Floats]:
    """
    Yield the distances (N, M) of all tracks and contacts of each scan, each at the track's time.

    Parameters
    ----------
    rows : TrackRows
        Sorted by scan.
    near : Matches
        Candidates within the cutoff; all other distances are the cutoff.
    stretches : Stretches
        Which are there.
    scans : int
        How many.
    cutoff : float
        [m]

    """
    numbers = np.arange(scans)
    first, end = (np.searchsorted(rows.scan, numbers, side=side) for side in ('left', 'right'))
    begin, stop = (np.searchsorted(near.scan, numbers, side=side) for side in ('left', 'right'))
    for k in range(scans):
        present: Ints = stretches.id[(stretches.first_scan <= k) & (k <= stretches.last_scan)]
        distance = np.full((end[k] - first[k], len(present)), float(cutoff))
        pair = slice(begin[k], stop[k])
        column = np.searchsorted(present, near.contact[pair])
        there = np.isin(near.contact[pair], present)
        row = near.row[pair][there] - first[k]
        distance[row, column[there]] = near.distance[pair][there]
        yield distance
