# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The measures of a single integrated air picture (SIAP), as far as they need no identities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_core.rows import take
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import TrackRows
from tracking_tools.scoring.stretches import Stretches

NAN = float('nan')


@dataclass(frozen=True)
class Siap:
    """Shares and means over all scans; every row counts, also one of an older look."""

    completeness: float = NAN  # share of the contacts that a track is on
    ambiguity: float = NAN  # tracks per contact that a track is on
    spuriousness: float = NAN  # share of the tracks that are on no contact
    position_accuracy: float = NAN  # mean distance [m]
    velocity_accuracy: float = NAN  # the same of the velocity [m/s]


def siap(rows: TrackRows, near: Matches, stretches: Stretches) -> Siap:
    """
    Judge the picture, every track being on the contact that is nearest to it.

    Parameters
    ----------
    rows : TrackRows
        What the tracker said.
    near : Matches
        All pairs of row and contact that may belong together.
    stretches : Stretches
        What was there.

    References
    ----------
    Votruba et al., Single integrated air picture (SIAP) metrics implementation, 2001.

    """
    on = nearest(near)
    there, held = int(stretches.length.sum()), len(np.unique(_pairs(on), axis=0))
    speed = np.linalg.norm(rows.velocity[on.row] - on.velocity, axis=1)
    return Siap(
        completeness=held / there if there else NAN,
        ambiguity=len(on) / held if held else NAN,
        spuriousness=(len(rows) - len(on)) / len(rows) if len(rows) else NAN,
        position_accuracy=_mean(on.distance),
        velocity_accuracy=_mean(speed),
    )


def nearest(near: Matches) -> Matches:
    """Return of each row its nearest contact only."""
    order = np.lexsort((near.distance, near.row))
    first = np.diff(near.row[order], prepend=-1) != 0
    return take(near, np.sort(order[first]))


def _pairs(on: Matches) -> Floats:
    return np.stack([on.scan, on.contact], axis=1)


def _mean(values: Floats) -> float:
    return float(values.mean()) if len(values) else NAN
