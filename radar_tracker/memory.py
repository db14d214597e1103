# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a radar tracker know that its parameters do not tell? For a restart of its node."""

from __future__ import annotations

from typing import Any

from msg_adapters.snapshots.form import check_form
from radar_tracker.build import build_setup
from radar_tracker.sensor import Radar
from radar_tracker.tracker import RadarTracker
from tracking_core.tracker import Tracker

KEPT = ('_is_known', '_farthest', '_last_coverage')


def remember(tracker: RadarTracker) -> dict[str, Any]:
    """Return batches, numbers and dictionaries of them; nothing in them will change."""
    mine = vars(tracker)
    radar = mine['_radar']
    return {
        'dimensions': radar.dimensions,
        'is_polar': radar.is_polar,
        'antenna': dict(vars(mine['_antenna'])),
        'sectors': dict(vars(tracker.sectors)),
        'turns': dict(vars(mine['_turns'])) if mine['_turns'] is not None else {},
        'state': tracker.state,
        **{name: mine[name] for name in KEPT},
    }


def recall(tracker: RadarTracker, memory: dict[str, Any]) -> None:
    """Go on from what was remembered; ValueError where it is not of a radar like this."""
    dimensions = memory['dimensions']
    if dimensions not in (2, 3):
        raise ValueError(f'a radar of {dimensions} dimensions')
    radar = Radar(tracker.config.sensor, dimensions, bool(memory['is_polar']))
    core = Tracker(build_setup(tracker.config, radar))
    vars(tracker).update(_radar=radar, _tracker=core)
    check_form(memory, remember(tracker))
    core.state = memory['state']
    vars(vars(tracker)['_antenna']).update(memory['antenna'])
    vars(tracker.sectors).update(memory['sectors'])
    if memory['turns']:
        vars(vars(tracker)['_turns']).update(memory['turns'])
    vars(tracker).update({name: memory[name] for name in KEPT})
