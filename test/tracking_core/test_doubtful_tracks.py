# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How probable is a track whose plots may be clutter, by whatever association?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.association import ASSOCIATORS, DECIDING
from tracking_core.batches import Plots, Tracks
from tracking_core.config import with_values
from tracking_core.rows import change

PLACES = np.array([[9_000.0, 4_000.0], [9_000.0, 4_000.0], [9_050.0, 4_040.0], [9_050.0, 4_040.0]])


SITE = {
    'scan.assembly': 'snapshot',
    'sensor.position_sd': 20.0,
    'sensor.range_rate_sd': 1.0,
    'initiation.speed_max': 150.0,
    'clutter_density': 1e-7,
}


def followed(looks: int, rates=(), before_last: float | None = None, **values: object) -> Tracks:
    """
    Return the track after some looks of one plot each in clutter.

    The last ones have `rates`; the existence probability before the last look may be given.
    """
    site = {**SITE, **values}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), site))
    known = [np.nan] * (looks - len(rates)) + list(rates)
    for number, (place, rate) in enumerate(zip(PLACES[:looks], known, strict=True)):
        if before_last is not None and number == looks - 1:
            tracks = replace(tracker.tracks, existence_probability=np.full(1, before_last))
            tracker.state = replace(tracker.state, tracks=tracks)
        plots = Plots.cartesian(np.full(1, 4.0 * number), place[None], range_rate=np.full(1, rate))
        tracks = tracker.track(replace(plots, stamp=4.0 * number))
    assert len(tracks) == 1
    return tracks


@pytest.mark.parametrize('association', ASSOCIATORS)
@pytest.mark.parametrize(('looks', 'low', 'high'), [(3, 0.7, 0.9), (4, 0.99, 0.9999)])
def test_plot_in_clutter_proves_as_much_by_any_association(association, looks, low, high) -> None:
    """Of one track and one plot each knows that the plot may be clutter, and the track nobody."""
    (found,) = followed(looks, association=association).existence_probability
    assert low < found < high
    assert found == pytest.approx(followed(looks).existence_probability[0], abs=1e-3)


def test_doubtful_track_goes_as_far_to_its_plot_as_a_sure_one() -> None:
    """Its state is that of the contact if there is one: doubt is in the existence alone."""
    faint = {'sensor.detection_probability': 0.3, 'clutter_density': 3e-6}
    doubtful, sure = (followed(3, before_last=r, **faint) for r in (0.4, 0.999))
    assert doubtful.existence_probability[0] < 0.7
    for one, other in zip(doubtful.planes[0].moments(), sure.planes[0].moments(), strict=True):
        assert_allclose(one, other, rtol=1e-9)


def test_range_rate_that_fits_proves_more_than_a_place_alone() -> None:
    """Of a false plot it would be anything up to `range_rate_max`: odds by the ratio of both."""
    place, both = followed(3), followed(3, rates=[0.0])
    wide = followed(3, rates=[0.0], **{'sensor.range_rate_max': 1200.0})
    r, s, w = (tracks.existence_probability[0] for tracks in (place, both, wide))
    assert s > 0.95
    assert r < 0.9
    # The density of false range rates halves where they may be twice as large.
    assert w / (1.0 - w) == pytest.approx(2.0 * s / (1.0 - s), rel=0.05)


@pytest.mark.parametrize('association', DECIDING)
@pytest.mark.parametrize(('existence', 'owner'), [(0.05, 1), (0.9999, 2)])
def test_doubtful_track_takes_no_plot_from_a_sure_one(association, existence, owner) -> None:
    """Of two tracks beside a plot the nearer one has it, unless its contact hardly exists."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), {**SITE, 'association': association}))
    place = np.array([9_000.0, 4_000.0, 0.0])
    tracker.track(replace(Plots.cartesian(np.zeros(1), place[None, :2]), stamp=0.0))
    for off in (-15.0, 12.0):
        tracker.start_track(place + np.array([off, 0.0, 0.0]), 0.0)
    sure, other = np.array([0.9999]), np.array([existence])
    tracks = change(tracker.tracks, existence_probability=np.concatenate([sure, other]))
    tracker.state = replace(tracker.state, tracks=tracks)
    tracks = tracker.track(replace(Plots.cartesian(np.full(1, 4.0), place[None, :2]), stamp=4.0))
    assert tracks.id[tracks.misses == 0].tolist() == [owner]
