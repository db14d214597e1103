# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Were the targets held, by one track each, and was there anything that is not real?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Ints
from tracking_core.rows import take
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import Targets, TrackRows

LEAST_ROWS = 5  # a ghost of fewer rows is not counted


@dataclass(frozen=True)
class Continuity:
    """How unbroken the tracks were."""

    held: float  # share of target time with a confirmed track
    per_target: dict[int, float]  # the same, of each target
    switches: int  # a target got another track than it had last
    breaks: int  # a held target was lost and held again
    ghosts: int  # tracks of `LEAST_ROWS` rows or more that were never near anything real
    tracks: int  # confirmed ids
    purity: float  # share of the matched rows of a track that are on its main target
    latency: float  # mean scans from when a target ought to be held to its first match


def continuity(rows: TrackRows, matches: Matches, near: Ints, targets: Targets) -> Continuity:
    """
    Judge the matches over time.

    Parameters
    ----------
    rows : TrackRows
        All that the tracker said.
    matches : Matches
        One-to-one matches.
    near : array
        Ids of tracks that were ever near anything real.
    targets : Targets
        What ought to be held, and when.

    """
    wanted = take(matches, targets.wanted(matches.target, matches.scan))
    length = targets.last_scan - targets.first_scan + 1
    count = np.array([np.unique(wanted.scan[wanted.target == t]).size for t in targets.id])
    ids, seen = np.unique(rows.id, return_counts=True)
    ghosts = ~np.isin(ids, near) & (seen >= LEAST_ROWS)
    return Continuity(
        held=float(count.sum() / max(length.sum(), 1)),
        per_target={int(t): float(share) for t, share in zip(targets.id, count / length,
                                                             strict=True)},
        switches=_switches(matches),
        breaks=_breaks(wanted),
        ghosts=int(ghosts.sum()),
        tracks=len(ids),
        purity=_purity(matches),
        latency=_latency(wanted, targets),
    )  # fmt: skip


def _by_target(matches: Matches) -> Matches:
    return take(matches, np.lexsort((matches.scan, matches.target)))


def _switches(matches: Matches) -> int:
    m = _by_target(matches)
    return int(((np.diff(m.target) == 0) & (np.diff(m.track) != 0)).sum())


def _breaks(matches: Matches) -> int:
    m = _by_target(matches)
    return int(((np.diff(m.target) == 0) & (np.diff(m.scan) > 1)).sum())


def _purity(matches: Matches) -> float:
    if len(matches) == 0:
        return float('nan')
    pairs, count = np.unique(np.stack([matches.track, matches.target]), axis=1, return_counts=True)
    tracks, number = np.unique(pairs[0], return_inverse=True)
    most = np.zeros(len(tracks), np.int64)
    np.maximum.at(most, number, count)
    return float(most.sum() / count.sum())


def _latency(wanted: Matches, targets: Targets) -> float:
    late = [
        wanted.scan[wanted.target == target].min() - first
        for target, first in zip(targets.id, targets.first_scan, strict=True)
        if (wanted.target == target).any()
    ]
    return float(np.mean(late)) if late else float('nan')
