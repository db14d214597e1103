# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How soon does the manoeuvre probability tell that a contact turns?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import TrackRows, Truth

NAN = float('nan')
SURE = 0.5  # manoeuvre probability that counts as told
QUIET = 3  # samples straight before, and turning after, the onset of a manoeuvre


def onset_delays(
    rows: TrackRows, probability: Floats, matches: Matches, contact: Truth
) -> list[float]:
    """
    Return the delay [s] of each manoeuvre of one contact that a track was on.

    It is the time from the onset to the first row that tells, NaN: none did in the turn.

    Parameters
    ----------
    rows : TrackRows
        What the tracker said.
    probability : (N,) array
        Of a manoeuvre, row by row; NaN where the tracker does not tell.
    matches : Matches
        Of this contact.
    contact : Truth
        Its samples.

    """
    time, tells = rows.time[matches.row], probability[matches.row]
    known, told = np.isfinite(tells), tells >= SURE
    delays = []
    for first, last in zip(*_turns(contact), strict=True):
        onset = 0.5 * (contact.time[first - 1] + contact.time[first])
        inside = known & (time >= onset) & (time <= contact.time[last])
        if inside.any():
            sure = time[inside & told]
            delays.append(float(sure.min() - onset) if len(sure) else NAN)
    return delays


def _turns(contact: Truth) -> tuple[list[int], list[int]]:
    """Return first and last sample of each turn that begins after straight motion."""
    edge = np.flatnonzero(np.diff(contact.turning.astype(int), prepend=0, append=0))
    first, last = edge[::2], edge[1::2] - 1
    before = np.concatenate([[-1], last[:-1]])
    fits = (first - before > QUIET) & (last - first + 1 >= QUIET)
    return first[fits].tolist(), last[fits].tolist()


def false_alarms(probability: Floats, matches: Matches) -> float:
    """
    Return in which share of the rows on straight contacts a manoeuvre was told.

    Parameters
    ----------
    probability : (N,) array
        Of a manoeuvre, as all rows tell it; NaN: not told.
    matches : Matches
        Rows and their contacts.

    """
    told = probability[matches.row[~matches.turning]]
    told = told[np.isfinite(told)]
    return float((told >= SURE).mean()) if len(told) else NAN
