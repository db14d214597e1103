# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How good are the tracks of a recording? From bags to figures, without a ROS graph.

Read ``reading`` (what is compared), ``judging`` (all figures), ``judgement`` (their names)
and ``text`` (how they are shown) in this order.
"""

from tracking_tools.evaluation.judgement import Judgement
from tracking_tools.evaluation.judging import evaluate, judge, Yardstick
from tracking_tools.evaluation.reading import read_recorded
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.evaluation.text import to_json, to_text

__all__ = [
    'Judgement',
    'Recorded',
    'Yardstick',
    'evaluate',
    'judge',
    'read_recorded',
    'to_json',
    'to_text',
]
