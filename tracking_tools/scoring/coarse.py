# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which rows could be near which contact? A coarse look in space and time that rules out most."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

from tracking_core.batches import Floats, Ints
from tracking_tools.scoring.records import TrackRows, Truth

STEPS = 300  # looks at a contact between the first and the last row
MARGIN = 1.5  # times what a contact moves from one look to the next


def plausible(
    rows: TrackRows, truth: Truth, radius: float, slack: float
) -> Iterator[tuple[Ints, Truth]]:
    """
    Yield each contact with the rows (K,) that may be within the radius of it.

    Parameters
    ----------
    rows : TrackRows
        What the tracker said.
    truth : Truth
        Of all contacts.
    radius : float
        [m]
    slack : float
        For so long before and after its samples a contact goes straight on [s].

    """
    contacts = [truth.of_contact(contact) for contact in np.unique(truth.id)]
    if rows.angular or len(rows) == 0:  # bearings have no box, and are few
        everything = np.arange(len(rows))
        yield from ((everything, contact) for contact in contacts)
        return
    step = max(float(np.ptp(rows.time)) / STEPS, 1e-3)
    looks = [_look(contact, rows.time.min() - step, rows.time.max() + step, slack, step)
             for contact in contacts]  # fmt: skip
    moved = [np.abs(np.diff(place, axis=0)).max(initial=0.0) for _, place in looks]
    reach = radius + MARGIN * max(moved, default=0.0)
    tree = cKDTree(np.column_stack([rows.position, rows.time * (reach / step)]))
    for contact, (time, place) in zip(contacts, looks, strict=True):
        points = cKDTree(np.column_stack([place, time * (reach / step)]))
        pairs = tree.sparse_distance_matrix(points, reach, p=np.inf, output_type='ndarray')
        yield np.unique(pairs['i']), contact


def _look(
    contact: Truth, first: float, last: float, slack: float, step: float
) -> tuple[Floats, Floats]:
    """Return where a contact is at moments that are `step` apart, and these moments."""
    begin, end = max(first, contact.time[0] - slack), min(last, contact.time[-1] + slack)
    if begin > end:
        return np.zeros(0), np.zeros((0, contact.position.shape[1]))
    time = np.append(np.arange(begin, end, step), end)
    return time, contact.at(time).position
