# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a sonar tracker know that its parameters do not tell? For a restart of its node."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from sonar_tracker.build import build_setup
from sonar_tracker.ranging_courses import Courses
from sonar_tracker.sensor import Sonar
from sonar_tracker.tracker import SonarTracker
from tracking_core.tracker import Tracker
from tracking_session.snapshots.form import check_form


def remember(tracker: SonarTracker) -> dict[str, Any]:
    """Return batches, numbers and dictionaries of them; nothing in them will change."""
    return {
        'usual_sd': tracker.sonar.usual_sd,
        'heading_sd': tracker.sonar.heading_sd,
        'heard': tracker.heard,
        'coverage': tracker.coverage,
        'state': tracker.state,
        'marks': tracker.ranging.history.remember(),
        'courses': asdict(tracker.ranging.courses),  # copies
    }


def recall(tracker: SonarTracker, memory: dict[str, Any]) -> None:
    """
    Go on from what was remembered.

    Raises
    ------
    ValueError
        Where it is not of a sonar like this; then the tracker is as it was.

    """
    check_form(memory, remember(tracker))
    (raised, *_) = memory['state'].scatter.raised()
    told = memory['usual_sd'], memory['heading_sd'], raised
    tracker.sonar = Sonar(tracker.config.sensor, *told)
    tracker.core = Tracker(build_setup(tracker.config, tracker.sonar))
    tracker.state, tracker.coverage = memory['state'], memory['coverage']
    tracker.heard = memory['heard']
    tracker.ranging.history.recall(memory['marks'])
    tracker.ranging.courses = Courses(**memory['courses'])
