# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How likely does a look at this contact give a plot? Small and far ones are seen more seldom.

The sensor has one detection probability for all. A track that were judged by it though its contact
gives a plot in every other look would end soon, and a new one with a new id would begin.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Ints, Tracks

_WEIGHT = 10.0  # looks that what is usual counts for
_CHANCE = 1.0  # a plot fewer than expected says nothing yet
_LEAST = 2.0 / 3.0  # of what is usual: what has left is not followed for longer than a dozen looks
REMEMBERED = 60  # looks in `Tracks.history`, as bits
_STRANGE = 0.1  # strange plots expected in the gate, with which the looks count half


def detection_probability(tracks: Tracks, usual: Floats, strange: Floats) -> Floats:
    """
    Return P_D of each track (T,): what is `usual` (T,), or less if its last looks say so.

    This is nearly the mean of a beta distribution after the looks that are remembered: a row of
    misses is weighed by how likely it is for a contact whose P_D is not known for sure. Never more
    than usual: who says less than there is wants patience. Looks count little where `strange` (T,)
    plots are expected in the gate: a track of clutter has few plots, too, and would be let live.
    """
    hits = ones(tracks.history)
    is_full = tracks.hits > hits  # the first looks are forgotten
    looks = np.where(is_full, REMEMBERED, lengths(tracks.history))
    trust = _STRANGE / (_STRANGE + strange)
    own = (_WEIGHT * usual + trust * hits + _CHANCE) / (_WEIGHT + trust * looks)
    return np.asarray(np.minimum(np.maximum(own, _LEAST * usual), usual))


def lengths(bits: Ints) -> Ints:
    """Return the number of bits of each (T,) from the first that is set."""
    # A bit below a set one is left out: 60 of them would be rounded up to the length 61.
    return np.asarray(np.frexp((bits & ~(bits >> 1)).astype(np.float64))[1], np.int64)


def ones(bits: Ints) -> Ints:
    """Return the number of set bits of each (T,)."""
    as_bytes = np.ascontiguousarray(bits)[:, None].view(np.uint8)
    return np.asarray(np.unpackbits(as_bytes, axis=1).sum(axis=1, dtype=np.int64))
