# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How was each contact held?"""

from __future__ import annotations

import numpy as np

from tracking_core.rows import take
from tracking_tools.evaluation.judgement import ContactJudgement
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.scoring import Matches, Stretches, track_error
from tracking_tools.scoring.continuity import find_changes
from tracking_tools.scoring.onsets import onset_delays
from tracking_tools.scoring.segments import holders, NOBODY, relative_tracking_time
from tracking_tools.scoring.stretches import spans

NAN = float('nan')


def judge_contacts(
    recorded: Recorded, matches: Matches, stretches: Stretches
) -> tuple[ContactJudgement, ...]:
    """Return the figures of every contact that was there while tracks were recorded."""
    return tuple(
        _contact(recorded, take(matches, matches.contact == contact), stretches, int(contact))
        for contact in np.unique(stretches.id)
    )


def _contact(
    recorded: Recorded, mine: Matches, stretches: Stretches, contact: int
) -> ContactJudgement:
    path, there = recorded.truth.of_contact(contact), stretches.of_contact(contact)
    ids, changes = holders(mine, there), find_changes(mine, there)
    begin, end, _ = spans(path)
    seen = (end >= recorded.starts[0]) & (begin < recorded.starts[-1])
    begin = np.maximum(begin[seen], recorded.starts[0])
    end = np.minimum(end[seen], recorded.starts[-1])
    delays = onset_delays(recorded.rows, recorded.manoeuvre_probability, mine, path)
    changed = np.diff(mine.track, prepend=NOBODY) != 0
    return ContactJudgement(
        contact=contact,
        duration=float((end - begin).sum()),
        coverage=float((ids != NOBODY).mean()),
        breaks=changes.breaks,
        id_switches=changes.switches,
        new_ids_after_absence=changes.returns,
        tracks=tuple(mine.track[changed].tolist()),
        relative_tracking_time=relative_tracking_time(ids),
        time_to_confirm=max(_first(recorded, mine) - float(begin[0]), 0.0) if len(mine) else NAN,
        onset_delays=tuple(delays),
        accuracy=track_error(recorded.rows, mine, recorded.has_velocity),
    )


def _first(recorded: Recorded, mine: Matches) -> float:
    return float(recorded.rows.time[mine.row].min())
