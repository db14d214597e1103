# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far is a set of estimates from the set of contacts? GOSPA, with its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from tracking_core.batches import Floats
from tracking_tools.scoring.records import TrackRows, Truth


@dataclass(frozen=True)
class GospaParts:
    """The metric, and for alpha = 2 what it is made of, each to the power p."""

    total: float  # [m]
    localisation: float  # sum over the pairs [m^p]
    missed: int  # contacts without an estimate
    false: int  # estimates without a contact


def gospa(
    estimates: Floats,
    contacts: Floats,
    cutoff: float = 1000.0,
    power: float = 2.0,
    alpha: float = 2.0,
) -> GospaParts:
    """
    Return the generalised optimal sub-pattern assignment metric of two sets of points.

    Parameters
    ----------
    estimates, contacts : (N, d), (M, d) arrays
        [m]
    cutoff : float
        c, the distance that counts as not found [m].
    power : float
        p.
    alpha : float
        2: a pair beyond the cutoff is a contact missed and an estimate false.

    References
    ----------
    Rahmathullah, Garcia-Fernandez and Svensson, Generalized optimal sub-pattern assignment
    metric, 2017, definition 1 and proposition 1.

    """
    N, M = len(estimates), len(contacts)
    distance = cdist(estimates, contacts) if N and M else np.zeros((N, M))
    return gospa_of_distances(distance, cutoff, power, alpha)


def gospa_of_distances(
    distance: Floats, cutoff: float, power: float = 2.0, alpha: float = 2.0
) -> GospaParts:
    """Return the metric from the distances (N, M) of estimates and contacts."""
    N, M = distance.shape
    if N == 0 or M == 0:
        return GospaParts(float((cutoff**power / alpha * (N + M)) ** (1.0 / power)), 0.0, M, N)
    cost = np.minimum(distance, cutoff) ** power
    paired = cost[linear_sum_assignment(cost)]
    close = paired < cutoff**power
    total = paired.sum() + cutoff**power / alpha * abs(N - M)
    found = int(close.sum())
    return GospaParts(
        float(total ** (1.0 / power)), float(paired[close].sum()), M - found, N - found
    )


def gospa_of_scans(
    rows: TrackRows, truth: Truth, scan_times: Floats, **options: float
) -> Sequence[GospaParts]:
    """
    Return the metric of every scan, for a sensor that sees everything at once.

    Parameters
    ----------
    rows : TrackRows
        What the tracker said; rows of scan k are compared with the truth at ``scan_times[k]``.
    truth : Truth
        A contact is there from its first sample to its last.
    scan_times : (K,) array
        [s]
    **options : float
        Of `gospa`.

    """
    contacts = [truth.of_contact(contact) for contact in np.unique(truth.id)]
    present = np.array([(c.time[0] <= scan_times) & (scan_times <= c.time[-1]) for c in contacts])
    places = np.array([contact.at(scan_times).position for contact in contacts])
    return [
        gospa(rows.position[rows.scan == k], places[present[:, k], k], **options)
        for k in range(len(scan_times))
    ]
