# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Were the contacts held, by one track each, and was there anything that is not real?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Ints
from tracking_core.rows import take
from tracking_tools.scoring.matching import Matches
from tracking_tools.scoring.records import TrackRows
from tracking_tools.scoring.stretches import Stretches

LEAST_ROWS = 5  # a ghost of fewer rows is not counted


@dataclass(frozen=True)
class Continuity:
    """How unbroken the tracks were."""

    held: float  # share of contact time with a confirmed track
    held_per_contact: dict[int, float]  # the same, of each contact
    switches: int  # a contact got another track than it had last
    breaks: int  # a held contact was lost and held again
    ghosts: int  # tracks of `LEAST_ROWS` rows or more that were never near anything real
    tracks: int  # confirmed ids
    purity: float  # share of the matched rows of a track that are on its main contact
    latency: float  # mean scans from when a contact ought to be held to its first match
    returns: int = 0  # a contact that had been out of sight got another track than it had last
    lasting_switches: int = 0  # those after which a contact never got its old track back


def continuity(
    rows: TrackRows,
    matches: Matches,
    near: Ints,
    stretches: Stretches,
    least_rows: int = LEAST_ROWS,
) -> Continuity:
    """
    Judge the matches over time.

    Parameters
    ----------
    rows : TrackRows
        All that the tracker said.
    matches : Matches
        One-to-one matches.
    near : (N,) array
        Ids of tracks that were ever near anything real.
    stretches : Stretches
        What ought to be held, and when.
    least_rows : int
        A ghost of fewer rows is not counted.

    """
    wanted = take(matches, stretches.wanted(matches.contact, matches.scan))
    real, row = np.unique(stretches.id, return_inverse=True)
    length = np.bincount(row, stretches.length, len(real))
    count = np.array([np.unique(wanted.scan[wanted.contact == c]).size for c in real])
    ids, seen = np.unique(rows.id, return_counts=True)
    ghosts = ~np.isin(ids, near) & (seen >= least_rows)
    changes = find_changes(matches, stretches)
    return Continuity(
        held=float(count.sum() / max(length.sum(), 1)),
        held_per_contact=dict(zip(real.tolist(), (count / length).tolist(), strict=True)),
        switches=changes.switches,
        breaks=find_changes(wanted, stretches).breaks,
        ghosts=int(ghosts.sum()),
        tracks=len(ids),
        purity=purity(matches.track, matches.contact),
        latency=_latency(wanted, stretches),
        returns=changes.returns,
        lasting_switches=_lasting(matches, stretches),
    )


@dataclass(frozen=True)
class Changes:
    """What happened to the tracks on contacts."""

    switches: int  # a contact in sight got another track
    breaks: int  # a contact in sight was lost and held again
    returns: int  # a contact that had been away got another track


def find_changes(matches: Matches, stretches: Stretches) -> Changes:
    """Count what happened to the tracks on contacts; matches of one contact or of many."""
    m = take(matches, np.lexsort((matches.scan, matches.contact)))
    same = np.diff(m.contact) == 0
    stretch = stretches.row_of(m.contact, m.scan)
    away = (stretch[1:] >= 0) & (stretch[:-1] >= 0) & (np.diff(stretch) != 0)
    other, gap = same & (np.diff(m.track) != 0), same & (np.diff(m.scan) > 1)
    counts = (other & ~away, gap & ~away, other & away)
    return Changes(*(int(count.sum()) for count in counts))


def _lasting(matches: Matches, stretches: Stretches) -> int:
    """Count the switches within stretches without those that lead back to an earlier track."""
    stretch = stretches.row_of(matches.contact, matches.scan)
    count = 0
    for row in range(len(stretches.id)):
        path: list[int] = []
        for track in matches.track[stretch == row]:
            path = path[: path.index(track)] if track in path else path
            path.append(track)
        count += max(len(path) - 1, 0)
    return count


def purity(track: Ints, contact: Ints) -> float:
    """Return which share of these pairs (K,) has the main contact of its track; NaN for none."""
    if len(track) == 0:
        return float('nan')
    pairs, count = np.unique(np.stack([track, contact]), axis=1, return_counts=True)
    tracks, number = np.unique(pairs[0], return_inverse=True)
    most = np.zeros(len(tracks), np.int64)
    np.maximum.at(most, number, count)
    return float(most.sum() / count.sum())


def _latency(wanted: Matches, stretches: Stretches) -> float:
    ids, row = np.unique(stretches.id, return_index=True)
    late = [
        wanted.scan[wanted.contact == contact].min() - first
        for contact, first in zip(ids, stretches.first_scan[row], strict=True)
        if (wanted.contact == contact).any()
    ]
    return float(np.mean(late)) if late else float('nan')
