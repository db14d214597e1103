# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a track keeps of its plots beside its state, and what becomes of one that is broken."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.rows import take

PLACES = np.array([[20e3, 0.0, 4e3], [0.0, 20e3, 4e3]])
SITE = {'scan.assembly': 'snapshot', 'clutter_density': 1e-13, 'sensor.position_sd': 30.0}


def scan(number: int, snr=np.nan) -> Plots:
    """Return the plots of two contacts at rest."""
    time = np.full(len(PLACES), 4.0 * number)
    plots = Plots.cartesian(time, PLACES, snr=np.full(len(PLACES), snr))
    return replace(plots, stamp=4.0 * number)


@pytest.mark.parametrize('plane', [0, 1])
def test_track_with_one_broken_plane_is_dropped(plane: int) -> None:
    """Over the ground or in height: a covariance that is none ends the track, and is counted."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), SITE))
    for number in range(5):
        tracks = tracker.track(scan(number))
    planes = list(tracks.planes)
    covariance = planes[plane].covariance.copy()
    covariance[1] *= -1.0
    planes[plane] = replace(planes[plane], covariance=covariance)
    tracker.state = replace(tracker.state, tracks=replace(tracks, planes=tuple(planes)))
    left = tracker.track(replace(take(scan(5), slice(0)), stamp=20.0))  # nobody was heard
    assert tracker.state.report.broken == 1
    assert tracks.id[1] not in left.id
    assert tracks.id[0] in left.id


def test_usual_snr_is_soon_that_of_the_first_plots() -> None:
    """The first is taken as it is, the next ones in equal parts with the plots before."""
    tracker, levels = RadarTracker(with_values(RadarTrackerConfig(), SITE)), []
    for number, snr in enumerate([10.0, 10.0, 20.0, 40.0, np.nan]):
        levels.append(tracker.track(scan(number, snr)).level)
    assert np.isnan(levels[1]).all()  # a track begins without: its plots may be clutter
    assert levels[2] == pytest.approx(20.0, rel=1e-3)
    assert levels[3] == pytest.approx(20.0 + 20.0 / 4.0, rel=1e-3)
    assert levels[4] == pytest.approx(levels[3])
