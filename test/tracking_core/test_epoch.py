# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Seconds since 1970 are good to 2.4e-7: no plot is lost by that."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings, Plots
from tracking_core.config import with_values

AZIMUTHS = np.array([-2.0, -0.5, 1.0, 2.5])
CELLS = {'sensor.range_resolution': 100.0, 'sensor.azimuth_resolution': 0.02}


def watched(tracker: RadarTracker | SonarTracker, epoch: float) -> tuple[int, int]:
    """Return misses and ids of four contacts, each seen at a time of its own in every look."""
    rng, misses = np.random.default_rng(3), 0
    for look in range(150):
        stamp = epoch + look + rng.uniform(0.0, 0.01)
        time = stamp + np.sort(rng.uniform(0.0, 0.3, len(AZIMUTHS)))
        azimuth = AZIMUTHS + rng.normal(0.0, 0.0005, len(AZIMUTHS))
        if isinstance(tracker, RadarTracker):
            tracks = tracker.track(
                replace(Plots.polar(time, np.full(len(time), 2e4), azimuth), stamp=stamp)
            )
        else:
            tracks = tracker.track(replace(Bearings.of(time, azimuth), stamp=stamp))
        misses += int((tracks.misses[tracks.confirmed] > 0).sum())
    return misses, tracker.state.next_id - 1


@pytest.mark.parametrize('epoch', [0.0, 1.7e9, 1.7e9 + 1.0 / 3.0])
@pytest.mark.parametrize('kind', ['radar', 'cells', 'sonar'])
def test_first_and_last_plot_of_a_look_are_in_it_at_any_epoch(kind: str, epoch: float) -> None:
    """A sensor that stares: its look is from the first plot to the last."""
    if kind == 'sonar':
        tracker: RadarTracker | SonarTracker = SonarTracker(SonarTrackerConfig())
    else:
        values = {'scan.assembly': 'snapshot', **(CELLS if kind == 'cells' else {})}
        tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    assert watched(tracker, epoch) == (0, len(AZIMUTHS))
