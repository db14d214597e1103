# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How did each confirmed track do?"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tracking_core.rows import take
from tracking_tools.evaluation.judgement import TrackJudgement
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.scoring import Matches, track_error
from tracking_tools.scoring.continuity import purity

NAN = float('nan')


def judge_tracks(
    recorded: Recorded, matches: Matches, near: Matches
) -> tuple[TrackJudgement, ...]:
    """Return the figures of every confirmed track; `near` says which were near anything real."""
    return tuple(_judge(recorded, matches, near))


def _judge(recorded: Recorded, matches: Matches, near: Matches) -> Iterator[TrackJudgement]:
    rows, start = recorded.rows, recorded.starts[0]
    nis = recorded.table.get('nis', np.full(len(rows), NAN)).astype(np.float64)
    new = rows.is_new
    for track in np.unique(rows.id):
        own = rows.id == track
        mine = take(matches, matches.track == track)
        error = track_error(rows, mine, recorded.has_velocity)
        time, squares = rows.time[own], nis[own & new]
        squares = squares[np.isfinite(squares)]
        yield TrackJudgement(
            track=int(track),
            contact=_main(mine if len(mine) else take(near, near.track == track)),
            begin=float(time.min() - start),
            end=float(time.max() - start),
            rows=int(own.sum()),
            matched=len(mine) / int(own.sum()),
            purity=purity(mine.track, mine.contact),
            rmse=error.rmse,
            nees_position=error.nees_position,
            nis=float(squares.mean() / recorded.plot_size) if len(squares) else NAN,
        )


def _main(mine: Matches) -> int | None:
    """Return the contact that a track was on most often, None for a false track."""
    if not len(mine):
        return None
    contacts, count = np.unique(mine.contact, return_counts=True)
    return int(contacts[count.argmax()])
