# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do the marks of a look say of a bearing by themselves? Data, free of the estimate."""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Innovations, Ints, Mixture
from tracking_core.linalg import sum_by_track


def as_data(
    mixture: Mixture, track: Ints, innovations: Innovations
) -> tuple[Floats, Floats, Floats]:
    """
    Undo the comparison of pairs with their tracks, in the likeliest mode.

    A mark is z = H x + what is not of this track: H is (h, h dt), where h is 1, or the track's
    share in an unresolved mark, and dt the time from the look to the mark. So the cross covariance
    is P H', and S is H P H' + R. The bearing is moved to the look by the track's rate.

    Parameters
    ----------
    mixture : Mixture
        The predicted bearings of T tracks.
    track : (P,) array
        Row of the track of each pair.
    innovations : Innovations
        Of the pairs.

    Returns
    -------
    bearing, variance, h : (P,) arrays
        What the mark says of the bearing, how surely, and the track's share in it.

    """
    mode, row = np.argmax(mixture.mode_probability, axis=1), np.arange(len(track))
    at = mode[track]
    cross = innovations.cross_covariance[row, at, :, :1]
    H = np.linalg.solve(mixture.covariance[track, at], cross)
    h = H[:, 0, 0]
    bearing = mixture.mean[track, at, 0] + innovations.innovation[row, at, 0] / h
    explained = (H * cross).sum(axis=(1, 2))
    return bearing, np.maximum(innovations.covariance[row, at, 0, 0] - explained, 0.0) / h**2, h


def average(
    share: Floats, bearing: Floats, variance: Floats, track: Ints, T: int
) -> tuple[Floats, Floats]:
    """Return the one mark (T,) that a track's marks (P,) are by their shares, and its variance."""
    mean = sum_by_track(share * bearing, track, T)
    return mean, sum_by_track(share * (variance + (bearing - mean[track]) ** 2), track, T)
