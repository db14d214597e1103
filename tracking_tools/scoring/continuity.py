# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Were the targets held, by one track each, and was there anything that is not real?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Ints
from tracking_core.rows import take
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import TrackRows
from tracking_tools.scoring.targets import Targets

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
    returns: int = 0  # a target that had been out of sight got another track than it had last
    lasting_switches: int = 0  # those after which a target never got its old track back


def continuity(
    rows: TrackRows, matches: Matches, near: Ints, targets: Targets, least_rows: int = LEAST_ROWS
) -> Continuity:
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
    least_rows : int
        A ghost of fewer rows is not counted.

    """
    wanted = take(matches, targets.wanted(matches.target, matches.scan))
    real, row = np.unique(targets.id, return_inverse=True)
    length = np.bincount(row, targets.length, len(real))
    count = np.array([np.unique(wanted.scan[wanted.target == t]).size for t in real])
    ids, seen = np.unique(rows.id, return_counts=True)
    ghosts = ~np.isin(ids, near) & (seen >= least_rows)
    changes = find_changes(matches, targets)
    return Continuity(
        held=float(count.sum() / max(length.sum(), 1)),
        per_target=dict(zip(real.tolist(), (count / length).tolist(), strict=True)),
        switches=changes.switches,
        breaks=find_changes(wanted, targets).breaks,
        ghosts=int(ghosts.sum()),
        tracks=len(ids),
        purity=purity(matches),
        latency=_latency(wanted, targets),
        returns=changes.returns,
        lasting_switches=_lasting(matches, targets),
    )


@dataclass(frozen=True)
class Changes:
    """What happened to the tracks on targets."""

    switches: int  # a target in sight got another track
    breaks: int  # a target in sight was lost and held again
    returns: int  # a target that had been away got another track


def find_changes(matches: Matches, targets: Targets) -> Changes:
    """Count what happened to the tracks on targets; matches of one target or of many."""
    m = take(matches, np.lexsort((matches.scan, matches.target)))
    same = np.diff(m.target) == 0
    stretch = targets.stretch(m.target, m.scan)
    away = (stretch[1:] >= 0) & (stretch[:-1] >= 0) & (np.diff(stretch) != 0)
    other, gap = same & (np.diff(m.track) != 0), same & (np.diff(m.scan) > 1)
    counts = (other & ~away, gap & ~away, other & away)
    return Changes(*(int(count.sum()) for count in counts))


def _lasting(matches: Matches, targets: Targets) -> int:
    """Count the switches within stretches without those that lead back to an earlier track."""
    stretch = targets.stretch(matches.target, matches.scan)
    count = 0
    for row in range(len(targets.id)):
        path: list[int] = []
        for track in matches.track[stretch == row]:
            path = path[: path.index(track)] if track in path else path
            path.append(track)
        count += max(len(path) - 1, 0)
    return count


def purity(matches: Matches) -> float:
    """Return which share of the matched rows is on the main target of its track."""
    if len(matches) == 0:
        return float('nan')
    pairs, count = np.unique(np.stack([matches.track, matches.target]), axis=1, return_counts=True)
    tracks, number = np.unique(pairs[0], return_inverse=True)
    most = np.zeros(len(tracks), np.int64)
    np.maximum.at(most, number, count)
    return float(most.sum() / count.sum())


def _latency(wanted: Matches, targets: Targets) -> float:
    ids, row = np.unique(targets.id, return_index=True)
    late = [
        wanted.scan[wanted.target == target].min() - first
        for target, first in zip(ids, targets.first_scan[row], strict=True)
        if (wanted.target == target).any()
    ]
    return float(np.mean(late)) if late else float('nan')
