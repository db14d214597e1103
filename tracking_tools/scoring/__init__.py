# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How good are the tracks? Measures of tracks against truth, without ROS.

Read ``records`` (what is compared), ``stretches`` (what ought to be held), ``matching`` (who is
whose), ``continuity``, ``accuracy`` and ``consistency`` (how well), ``gospa`` and ``ospa`` (all in
one figure), ``siap``, ``onsets``, ``sampling`` and ``score`` (all beside the plots) in this order.
"""

from tracking_tools.scoring.accuracy import Accuracy, plot_error, track_error
from tracking_tools.scoring.continuity import Continuity, continuity
from tracking_tools.scoring.gospa import gospa, gospa_of_scans, GospaParts
from tracking_tools.scoring.matching import match, Matches
from tracking_tools.scoring.records import (
    confirmed_rows,
    join_rows,
    PlotRows,
    TrackRows,
    Truth,
)
from tracking_tools.scoring.score import Score, score
from tracking_tools.scoring.stretches import Stretches

__all__ = [
    'Accuracy',
    'Continuity',
    'GospaParts',
    'Matches',
    'PlotRows',
    'Score',
    'Stretches',
    'TrackRows',
    'Truth',
    'confirmed_rows',
    'continuity',
    'gospa',
    'gospa_of_scans',
    'join_rows',
    'match',
    'plot_error',
    'score',
    'track_error',
]
