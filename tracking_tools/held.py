# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which track held which contact of a scene, and for how long?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from msg_adapters.table import Columns
from tracking_core.batches import Floats, Ints
from tracking_core.rows import take
from tracking_tools.evaluation.judging import RADIUS
from tracking_tools.evaluation.rows import position_rows
from tracking_tools.evaluation.truths import positions_of
from tracking_tools.scene import choose, Scene
from tracking_tools.scoring import match, Matches
from tracking_tools.scoring.stretches import OUT_OF_SIGHT

START = 3  # looks at a contact before anybody can have a track of it


@dataclass(frozen=True)
class Hold:
    """How one contact was held."""

    contact: int
    duration: float  # that it was in sight, pauses aside [s]
    share: float  # of its scans after `START` with a confirmed track on it; evaluate counts all
    tracks: Ints  # (K,) ids in order of appearance
    switches: int  # changes of the track while the contact was in sight
    returns: int  # changes of the track while it was out of sight
    error: float  # root mean square distance of the track [m]


def find_holds(scene: Scene) -> list[Hold]:
    """Return how each contact of the truth was held, if it is told at the stamps of tables."""
    if not scene.has_truth or not len(scene.published.get('id', ())):
        return []
    stamps = np.unique(scene.truth['stamp'])
    told = choose(scene.published, np.isin(scene.published['stamp'], stamps))
    if not len(told['id']):
        return []
    truth = positions_of(scene.truth, turning=np.inf)
    matches = match(position_rows(told, stamps, 3), truth, RADIUS['radar'])
    return [
        _hold(contact, scene.truth, stamps, matches) for contact in np.unique(scene.truth['id'])
    ]


def count_false(scene: Scene, holds: list[Hold]) -> int:
    """Count the confirmed tracks that never held a contact."""
    real = [number for hold in holds for number in hold.tracks]
    return len(np.setdiff1d(scene.published.get('id', ()), real))


def _hold(contact: int, truth: Columns, stamps: Floats, matches: Matches) -> Hold:
    path = choose(truth, truth['id'] == contact)
    mine = take(matches, matches.contact == contact)
    scans = np.searchsorted(stamps, path['stamp'])[START:]
    changed = np.flatnonzero(np.diff(mine.track)) + 1
    # Back in sight between the last scan of one track and the first of the next?
    absences = np.searchsorted(_returns(path['time']), stamps[mine.scan], side='right')
    lost = absences[changed] > absences[changed - 1]
    return Hold(
        contact=int(contact),
        duration=float(np.ptp(path['time']) - _gaps(path['time']).sum()),
        share=float(np.isin(scans, mine.scan).mean()) if len(scans) else 0.0,
        tracks=mine.track[np.concatenate([[0], changed])] if len(mine) else mine.track,
        switches=int(np.sum(~lost)),
        returns=int(np.sum(lost)),
        error=float(np.sqrt(np.mean(mine.distance**2))) if len(mine) else float('nan'),
    )


def _returns(time: Floats) -> Floats:
    """Return when a contact that was seen at these times (M,) came back into sight."""
    return time[_gaps(time) > 0.0]


def _gaps(time: Floats) -> Floats:
    """Return how long it had been out of sight at each of these times (M,), 0: not at all [s]."""
    steps = np.diff(time, prepend=time[0])
    return np.where(steps > OUT_OF_SIGHT * np.median(steps), steps, 0.0)
