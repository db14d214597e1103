# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How well does a sonar know ranges where it says that it can?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats
from tracking_core.rows import take
from tracking_tools.evaluation.judgement import Ranges
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.scoring import Matches
from tracking_tools.scoring.consistency import consistency

NAN = float('nan')


def judge_ranges(recorded: Recorded, matches: Matches) -> Ranges | None:
    """Return the errors of the ranges; None of a radar or of a table without ranges."""
    table, real = recorded.table, recorded.ranges
    if real is None or 'range' not in table or 'range_sd' not in table:
        return None
    told = take(matches, np.isfinite(table['range'][matches.row]))
    share = len(told) / len(matches) if len(matches) else NAN
    true = np.full(len(told), NAN)
    for contact in np.unique(told.contact):
        mine, path = told.contact == contact, real['id'] == contact
        time = recorded.rows.time[told.row[mine]]
        true[mine] = np.interp(time, real['time'][path], real['range'][path])
    error = table['range'][told.row].astype(np.float64) - true
    sd = table['range_sd'][told.row].astype(np.float64)
    return Ranges(_rms(error), _rms(error / true), consistency((error / sd) ** 2, 1), share)


def _rms(error: Floats) -> float:
    return float(np.sqrt(np.mean(error**2))) if len(error) else NAN
