# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What ought to be held, and when?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.rows import take
from tracking_tools.scoring.records import FALSE_PLOT, Truth

OUT_OF_SIGHT = 2.5  # times its usual interval: a contact without samples for so long is away


@dataclass(frozen=True)
class Stretches:
    """
    Stretches of scans in which a tracker ought to hold a contact.

    A contact that goes away and comes back has a row for each time; rows are sorted by contact,
    then scan.
    """

    id: Ints  # (J,)
    first_scan: Ints  # (J,)
    last_scan: Ints  # (J,) inclusive

    @staticmethod
    def of_plots(contact: Ints, scan: Ints, nth: int = 4) -> Stretches:
        """Return those with `nth` plots or more, from their nth plot to the last."""
        ids, first, last = [], [], []
        for one in np.unique(contact[contact != FALSE_PLOT]):
            scans = np.sort(scan[contact == one])
            if len(scans) >= nth:
                ids.append(one)
                first.append(scans[nth - 1])
                last.append(scans[-1])
        return Stretches(*(np.array(values, np.int64) for values in (ids, first, last)))

    @staticmethod
    def of_truth(truth: Truth, starts: Floats) -> Stretches:
        """
        Return those that the truth has samples of, as long as it has.

        Parameters
        ----------
        truth : Truth
            All contacts. A gap of `OUT_OF_SIGHT` usual intervals of a contact is an absence.
        starts : (K + 1,) array
            When each scan begins, and when the last one ends [s].

        """
        begin, end, ids = spans(truth)
        pause = OUT_OF_SIGHT * float(np.median(np.diff(starts)))  # longer, the tracker was silent
        over = np.minimum(starts[1:], starts[:-1] + pause)
        first = np.searchsorted(over, begin, side='right')
        last = np.searchsorted(starts[:-1], end, side='right') - 1
        seen = first <= last
        begin, end, ids = begin[seen], end[seen], ids[seen]
        first, last = first[seen], last[seen]
        if len(ids) == 0:
            return Stretches(ids, first, last)
        # An absence that no whole scan falls into is none, unless the tracker was silent, too.
        gone = (first[1:] > last[:-1] + 1) | (begin[1:] - end[:-1] > pause)
        away = (np.diff(ids) != 0) | gone
        begins, ends = np.append(True, away), np.append(away, True)
        return Stretches(ids[begins], first[begins], last[ends])

    @property
    def length(self) -> Ints:
        """How many scans (J,) each stretch has."""
        return self.last_scan - self.first_scan + 1

    def row_of(self, contact: Ints, scan: Ints) -> Ints:
        """Return for pairs of contact and scan (N,) the row (N,) that they are in, -1 for none."""
        if len(self.id) == 0:
            return np.full(len(contact), -1)
        span = int(max(self.last_scan.max(), scan.max(initial=0))) + 1
        begins = self.id * span + self.first_scan
        row = np.searchsorted(begins, contact * span + scan, side='right') - 1
        inside = (row >= 0) & (self.id[row] == contact) & (scan <= self.last_scan[row])
        return np.where(inside, row, -1)

    def wanted(self, contact: Ints, scan: Ints) -> Bools:
        """Return for pairs of contact and scan (N,) whether the contact ought to be held there."""
        return self.row_of(contact, scan) >= 0

    def of_contact(self, contact: int) -> Stretches:
        """Return the stretches of one contact."""
        return take(self, self.id == contact)


def spans(truth: Truth) -> tuple[Floats, Floats, Ints]:
    """Return from when to when (J,) [s] contacts are there without a gap, and their ids (J,)."""
    if len(truth.id) == 0:
        return np.zeros(0), np.zeros(0), np.zeros(0, np.int64)
    cut = absences(truth.id, truth.time)
    first, last = np.append(0, cut), np.append(cut, len(truth.id)) - 1
    return truth.time[first], truth.time[last], truth.id[first]


def absences(ids: Ints, time: Floats) -> Ints:
    """
    Return the rows (C,) that begin another contact or follow an absence of the same one.

    Parameters
    ----------
    ids, time : (N,) arrays
        Of samples sorted by contact, then time [s].

    """
    other = ids[1:] != ids[:-1]
    edges, step = np.flatnonzero(other) + 1, np.diff(time)
    usual = [_usual(np.diff(part)) for part in np.split(time, edges)]
    lengths = np.diff(np.concatenate([[0], edges, [len(ids)]]))
    return np.flatnonzero(other | (step > OUT_OF_SIGHT * np.repeat(usual, lengths)[1:])) + 1


def _usual(steps: Floats) -> float:
    """Return the usual interval of a contact's samples, of which some may be copies [s]."""
    steps = steps[steps > 0.0]
    return float(np.median(steps)) if len(steps) else np.inf
