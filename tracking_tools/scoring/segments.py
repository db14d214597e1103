# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How long does one track stay on a contact?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Ints
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.stretches import Stretches

NOBODY = -1


def holders(matches: Matches, stretches: Stretches) -> Ints:
    """
    Return which track held a contact, scan by scan while it was there.

    Parameters
    ----------
    matches : Matches
        Of one contact.
    stretches : Stretches
        Its stretches, one or more.

    Returns
    -------
    (K,) array
        Ids, `NOBODY` for none.

    """
    scans = np.concatenate(
        [
            np.arange(a, b + 1)
            for a, b in zip(stretches.first_scan, stretches.last_scan, strict=True)
        ]
    )
    ids = np.full(len(scans), NOBODY)
    here = np.isin(matches.scan, scans)
    ids[np.searchsorted(scans, matches.scan[here])] = matches.track[here]
    return ids


def segment_lengths(ids: Ints) -> Ints:
    """Return how many scans each unbroken stay of one track has; ids (K,) as of `holders`."""
    edge = np.flatnonzero(np.diff(ids, prepend=NOBODY - 1, append=NOBODY - 1))
    return np.asarray(np.diff(edge)[ids[edge[:-1]] != NOBODY])


def relative_tracking_time(ids: Ints) -> float:
    """
    Return the mean length of unbroken stays over the time that the contact was there.

    One break halves it, however short; ids (K,) as of `holders`.

    References
    ----------
    [VORONINA19] eq. 16.

    """
    lengths = segment_lengths(ids)
    return float(lengths.mean() / len(ids)) if len(lengths) else 0.0
