# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a sonar tracker know that its parameters do not tell? For a restart of its node."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from msg_adapters.snapshots.form import check_form
from sonar_tracker.build import build_setup
from sonar_tracker.ranging import Courses
from sonar_tracker.sensor import Sonar
from sonar_tracker.tracker import SonarTracker
from tracking_core.tracker import Tracker


def remember(tracker: SonarTracker) -> dict[str, Any]:
    """Return batches, numbers and dictionaries of them; nothing in them will change."""
    mine = vars(tracker)
    ranging = vars(mine['_ranging'])
    history, courses = vars(ranging['_history']), ranging['_courses']
    return {
        'usual_sd': mine['_sonar'].usual_sd,
        'heard': mine['_heard'],
        'coverage': tracker.coverage,
        'state': tracker.state,
        'marks': {name: history[name].copy() for name in ('id', '_count')},
        'points': np.swapaxes(history['_points'], 0, 1).copy(),  # (T, 5, K)
        'courses': {f.name: getattr(courses, f.name).copy() for f in fields(courses)},
    }


def recall(tracker: SonarTracker, memory: dict[str, Any]) -> None:
    """Go on from what was remembered; ValueError where it is not of a sonar like this."""
    check_form(memory, remember(tracker))
    sonar = Sonar(tracker.config.sensor, memory['usual_sd'])
    core = Tracker(build_setup(tracker.config, sonar))
    core.state = memory['state']
    ranging = vars(vars(tracker)['_ranging'])
    points = np.swapaxes(memory['points'], 0, 1).copy()
    vars(ranging['_history']).update(memory['marks'], _points=points)
    ranging['_courses'] = Courses(**memory['courses'])
    vars(tracker).update(
        _sonar=sonar, _tracker=core, _coverage=memory['coverage'], _heard=memory['heard']
    )
