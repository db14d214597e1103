# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the very first plots teach must not stand in the way of the next ones."""

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.memory import recall, remember
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

PERIOD = 4.0  # [s]
PLACE = np.array([10_000.0, 0.0, 0.0])


def tracker_of(**values):
    """Return a radar tracker with these parameters, underscores for points."""
    named = {name.replace('__', '.'): value for name, value in values.items()}
    return RadarTracker(with_values(RadarTrackerConfig(), named))


def scan(number, distance, azimuth):
    """Return the plots of one look."""
    time = np.full(len(distance), PERIOD * number)
    return replace(Plots.polar(time, np.array(distance), np.array(azimuth)), stamp=PERIOD * number)


@pytest.mark.parametrize('nearest', [0.0, 50.0, 100.0])
def test_near_echo_alone_at_first_does_not_keep_tracks_from_starting(nearest):
    """One plot just beyond `range_min`, then three contacts: confirmed as soon as without it."""
    needed = []
    for first in (nearest + 1.0, 20e3):
        tracker = tracker_of(sensor__range_min=nearest)
        tracker.track(scan(0, [first], [1.0]))
        for number in range(1, 60):
            flown = 100.0 * PERIOD * number
            distance = np.hypot([8e3 + flown, 12e3, 15e3], [0.0, flown, -flown])
            tracks = tracker.track(scan(number, distance, [0.0, 1.5, -2.0]))
            if tracks.confirmed.sum() >= 3:
                break
        needed.append(number)
    assert needed[0] == needed[1] < 8


def heights(number, *known):
    """Return the plots of three contacts in one look, of which some have a height."""
    elevation = np.where(known, [0.3, 0.2, 0.1], np.nan)
    return replace(scan(number, [8e3, 12e3, 15e3], [0.0, 1.5, -2.0]), elevation=elevation)


def test_first_height_makes_a_radar_3d_until_a_track_is_confirmed():
    """The first sector may have no plot with a height; a later one ends no tracks."""
    early, late = tracker_of(), tracker_of()
    for number in range(10):
        early.track(heights(number, number > 0, number > 1, number > 2))
        late.track(heights(number, number > 8, False, False))
    assert early.radar.dimensions == 3
    assert early.tracks.confirmed.sum() == 3
    assert late.radar.dimensions == 2
    assert late.tracks.id.tolist() == [1, 2, 3]


@pytest.mark.parametrize('odd', [1, 2])
def test_height_that_none_follows_keeps_no_track_from_starting(odd):
    """One faulty message, or two long after each other: the others tell none, and so it is 2-D."""
    tracker = tracker_of()
    for number in range(80):
        tracker.track(heights(number, number in (0, 50)[:odd], False, False))
    assert tracker.radar.dimensions == 2
    assert tracker.tracks.confirmed.sum() == 3
    assert tracker.tracks.id.min() < 10


def test_heights_that_are_seldom_are_believed():
    """One contact of three has one, half of the time: it is tracked in 3-D, as long as it is."""
    tracker = tracker_of()
    for number in range(80):
        tracker.track(heights(number, number % 2 == 0, False, False))
    assert tracker.radar.dimensions == 3
    assert tracker.tracks.confirmed.any()


@pytest.mark.parametrize(
    ('known', 'dimensions'),
    [
        ([0] * 10 + [1], 3),
        ([1] + [0] * 33, 3),
        ([1] + [0] * 34, 2),
        ([1] + [0] * 34 + [1], 2),
        ([1] + [0] * 30 + [1] + [0] * 30, 3),
    ],
    ids=['late', 'seldom', 'never again', 'once more', 'now and then'],
)
def test_a_hundred_false_plots_in_a_row_without_height_make_a_radar_2d(known, dimensions):
    """Three in a look, nowhere twice, and no contact: the height of one is known, or of none."""
    tracker, rng = RadarTracker(RadarTrackerConfig()), np.random.default_rng(1)
    for number, has_height in enumerate(known):
        at = rng.uniform(-1e5, 1e5, (3, 3))
        at[has_height:, 2] = np.nan
        tracker.track(Plots.cartesian(np.full(3, 4.0 * number), at))
    assert tracker.radar.dimensions == dimensions


def test_plot_at_the_least_range_is_a_plot():
    """As the only plot so far it leaves no depth to count false plots in."""
    tracker = tracker_of(sensor__range_min=100.0)
    for number in range(3):
        tracker.track(scan(number, [100.0], [1.0]))
    assert np.isfinite(tracker.state.clutter.density)


def test_ordered_track_outlives_the_first_plots():
    """Ordered while the radar saw nothing; the first plot is of it."""
    tracker = tracker_of(sensor__dimensions=2)
    tracker.track(scan(0, [], []))
    assert tracker.is_ready
    number = tracker.start_track(PLACE, 0.0)
    tracks = tracker.track(scan(1, [1e4], [0.0]))
    assert tracks.id.tolist() == [number]
    assert tracks.hits[0] > 0


def test_tracks_are_not_ordered_before_it_is_known_what_they_are():
    """2-D or 3-D: a parameter or the first plots tell."""
    tracker = tracker_of()
    assert not tracker.is_ready
    tracker.track(scan(0, [1e4], [0.0]))
    assert tracker.is_ready


def test_memory_of_another_radar_is_refused_and_changes_nothing():
    """A part is missing: the tracker is as it was, to the object."""
    solid = tracker_of(sensor__dimensions=3)
    memory = remember(solid)
    del memory['antenna']
    tracker = tracker_of()
    tracker.track(scan(0, [1e4, 2e4], [0.0, 1.0]))
    before = dict(vars(tracker))
    with pytest.raises(ValueError, match='antenna'):
        recall(tracker, memory)
    assert all(value is before[name] for name, value in vars(tracker).items())


def test_memory_of_a_radar_that_cannot_be_is_refused():
    """Of one dimension, say, in a file that somebody wrote."""
    with pytest.raises(ValueError, match='a radar of 1 dimensions'):
        recall(tracker_of(), {**remember(tracker_of()), 'dimensions': 1})


def test_recalled_radar_knows_how_its_antenna_turns_and_half_a_turn():
    """Six sectors to a turn, each with three plots; recalled in the middle of one."""
    tracker, other = (tracker_of(scan__assembly='rotation') for _ in range(2))
    for sector in range(33):
        azimuth = (sector + np.array([0.2, 0.5, 0.8])) * np.pi / 3.0
        time = azimuth / (2.0 * np.pi) * PERIOD
        plots = replace(Plots.polar(time, np.full(3, 1e4), azimuth), stamp=sector * PERIOD / 6.0)
        if sector == 20:
            recall(other, remember(tracker))
            assert other.antenna.rotation_rate == pytest.approx(2.0 * np.pi / PERIOD)
        tracker.track(plots)
        if sector >= 20:
            other.track(plots)
            assert other.tracks.time.tolist() == tracker.tracks.time.tolist()
    assert len(other.tracks) == 18
