# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are plots weighed for a track alone? Probabilistic data association."""

from __future__ import annotations

import numpy as np

from tracking_core.association.sums import choose
from tracking_core.batches import Association, Floats, Ints


def pda(track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int) -> Association:
    """
    Weigh the plots of each track as if there were no other track.

    A plot in two gates is counted for both tracks. See `Associator` for the arguments.

    References
    ----------
    [BARSHALOM75], with the existence probability of [MUSICKI94] in the weights.

    """
    del plot, plots  # other tracks do not matter
    tracks = len(log_miss)
    probability, miss, _ = choose(track, log_weight - log_miss[track], tracks)
    return Association(probability, miss, np.zeros(tracks, np.bool_))
