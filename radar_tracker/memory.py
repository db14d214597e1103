# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a radar tracker know that its parameters do not tell? For a restart of its node."""

from __future__ import annotations

from typing import Any

from radar_tracker.build import build_setup
from radar_tracker.sensor import Radar
from radar_tracker.tracker import RadarTracker
from tracking_core.tracker import Tracker
from tracking_session.snapshots.form import check_form

# What learns replaces its attributes and never changes them in place, so references will do.
LEARNING = ('antenna', 'sectors', 'turns')
PLAIN = ('is_known', 'flat', 'farthest', 'coverage', 'state')


def remember(tracker: RadarTracker) -> dict[str, Any]:
    """Return batches, numbers and dictionaries of them; nothing in them will change."""
    return {
        'dimensions': tracker.radar.dimensions,
        'is_polar': tracker.radar.is_polar,
        **{name: dict(_known(tracker, name)) for name in LEARNING},
        **{name: getattr(tracker, name) for name in PLAIN},
    }


def recall(tracker: RadarTracker, memory: dict[str, Any]) -> None:
    """
    Go on from what was remembered.

    Raises
    ------
    ValueError
        Where it is not of a radar like this; then the tracker is as it was.

    """
    if memory['dimensions'] not in (2, 3):
        raise ValueError(f'a radar of {memory["dimensions"]} dimensions')
    fresh = RadarTracker(tracker.config)
    fresh.radar = Radar(fresh.config.sensor, memory['dimensions'], bool(memory['is_polar']))
    fresh.core = Tracker(build_setup(fresh.config, fresh.radar))
    check_form(memory, remember(fresh))
    tracker.radar, tracker.core = fresh.radar, fresh.core
    for name in LEARNING:
        _known(tracker, name).update(memory[name])
    for name in PLAIN:
        setattr(tracker, name, memory[name])


def _known(tracker: RadarTracker, name: str) -> dict[str, Any]:
    """Return the attributes themselves of what learns, {} where a tracker has none of it."""
    learning = getattr(tracker, name)
    return {} if learning is None else vars(learning)
