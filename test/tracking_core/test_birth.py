# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One new track a plot, though several earlier plots may be its contact's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings, Plots
from tracking_core.birth import one_a_plot
from tracking_core.config import with_values
from tracking_core.initiation import Starts


def test_one_a_plot_is_the_mixture_of_all_starts_of_the_plot() -> None:
    """Moments by the share of each, existence that of any; a plot's only start stays as it is."""
    rng = np.random.default_rng(3)
    mean, root = rng.normal(size=(3, 2, 2)), rng.normal(size=(3, 4, 4))
    P = root @ root.swapaxes(1, 2)
    existence, plot = np.array([0.2, 0.5, 0.6]), np.array([4, 1, 4])
    made = one_a_plot(Starts(mean, P.reshape(3, 2, 2, 2, 2), existence, plot, 2), 6)
    assert_array_equal(made.plot, [1, 4])
    assert_allclose(made.existence_probability, [0.5, 1.0 - 0.8 * 0.4])
    assert_allclose(made.mean[0], mean[1])
    assert_allclose(made.covariance[0].reshape(4, 4), P[1])
    flat, share = mean.reshape(3, 4), np.array([0.25, 0.75])
    centre = share @ flat[[0, 2]]
    square = P[[0, 2]] + np.einsum('ka,kb->kab', flat[[0, 2]], flat[[0, 2]])
    assert_allclose(made.mean[1].reshape(4), centre)
    expected = np.einsum('k,kab->ab', share, square) - np.outer(centre, centre)
    assert_allclose(made.covariance[1].reshape(4, 4), expected)


def test_one_a_plot_takes_starts_that_are_sure() -> None:
    """Nothing is divided by zero, and two sure ones are no surer than sure."""
    made = one_a_plot(
        Starts(
            np.zeros((2, 1, 2)), np.ones((2, 1, 2, 1, 2)), np.ones(2), np.zeros(2, np.int64), 2
        ),
        1,
    )
    assert 1.0 - 1e-9 <= made.existence_probability[0] <= 1.0


def test_two_noisy_heights_climb_no_faster_than_contacts() -> None:
    """1500 m apart in 4 s by noise alone: the climb limit of 100 m/s says that it is noise."""
    values = {
        'scan.assembly': 'snapshot', 'sensor.dimensions': 3, 'sensor.position_sd': 500.0,
        'clutter_density': 1e-14, 'initiation.climb_max': 100.0,
    }  # fmt: skip
    tracker = RadarTracker(with_values(RadarTrackerConfig(), values))
    for time, x, height in ((0.0, 20_000.0, 5_000.0), (4.0, 20_800.0, 6_500.0)):
        message = Plots.cartesian(np.array([time]), np.array([[x, 0.0, height]]))
        tracks = tracker.track(replace(message, stamp=time))
    mean, P = tracks.planes[1].moments()
    assert len(tracks) == 1
    assert mean[0, 1] < 50.0
    assert np.sqrt(P[0, 1, 1]) < 100.0 / np.sqrt(3.0)


def test_contacts_side_by_side_are_confirmed_as_soon_as_one_alone() -> None:
    """Each of their plots may follow four others: that makes no sixteen doubtful tracks."""
    rng = np.random.default_rng(2)
    abreast = 400.0 * np.arange(4.0)[:, None] * [0.0, 1.0] + [5_000.0, 5_000.0]
    tracker = RadarTracker(
        with_values(
            RadarTrackerConfig(),
            {
                'scan.assembly': 'snapshot',
                'sensor.position_sd': 100.0,
                'sensor.range_max': 40_000.0,
                'initiation.speed_max': 300.0,
                'clutter_density': 1e-9,
            },
        )
    )
    for scan in range(3):
        place = abreast + [150.0 * 4.0 * scan, 0.0] + 100.0 * rng.standard_normal((4, 2))
        message = Plots.cartesian(np.full(4, 4.0 * scan), place)
        tracks = tracker.track(replace(message, stamp=4.0 * scan))
    assert len(tracks) == tracks.confirmed.sum() == 4


def after(looks, **values):
    """Return a tracker after looks every 4 s, each a list of places (x, y) or (x, y, z)."""
    site = {
        'scan.assembly': 'snapshot',
        'sensor.position_sd': 20.0,
        'sensor.range_max': 40_000.0,
        'initiation.speed_max': 150.0,
        'clutter_density': 1e-10,
        **{name.replace('__', '.'): value for name, value in values.items()},
    }
    tracker = RadarTracker(with_values(RadarTrackerConfig(), site))
    for number, places in enumerate(looks):
        position = np.asarray(places, float).reshape(len(places), -1 if places else 2)
        message = Plots.cartesian(np.full(len(places), 4.0 * number), position)
        tracker.track(replace(message, stamp=4.0 * number))
    return tracker


HERE, BESIDE = (9_000.0, 4_000.0), (9_000.0, 4_400.0)


@pytest.mark.parametrize(
    ('memory', 'gap', 'starts'),
    [(1.5, 1, 1), (1.5, 2, 0), (2.5, 2, 1), (2.5, 3, 0), (3.5, 3, 1), (3.5, 4, 0)],
)
def test_plot_waits_for_a_second_one_as_long_as_its_memory(memory, gap, starts) -> None:
    """So many looks later a second one starts a track, after one look more it does not."""
    looks = [[HERE], *[[]] * (gap - 1), [HERE]]
    tracker = after(looks, initiation__memory=memory)
    assert len(tracker.tracks) == tracker.state.report.started == starts


def turning(azimuth: float, turns: tuple[int, ...], sectors: int, memory: float) -> int:
    """Return how many tracks a contact makes that has plots in these turns of eight."""
    site = {'scan.assembly': 'sector' if sectors > 1 else 'message', 'scan.period': 4.0}
    site |= {'initiation.memory': memory, 'clutter_density': 1e-9, 'sensor.range_max': 4e4}
    tracker, others = RadarTracker(with_values(RadarTrackerConfig(), site)), 0.6 * np.arange(10)
    for number in range(8 * sectors):
        turn, begin = number // sectors, 2.0 * np.pi * (number % sectors) / sectors
        seen = np.sort(np.append(others, azimuth) if turn in turns else others)
        seen = seen[(seen >= begin) & (seen < begin + 2.0 * np.pi / sectors)]
        place = np.where(seen == azimuth, 30e3, 8e3)
        message = Plots.polar(4.0 * (turn + seen / (2.0 * np.pi)), place, seen)
        tracks = tracker.track(replace(message, stamp=4.0 * number / sectors))
        far = np.linalg.norm(tracks.planes[0].average[:, 0::2], axis=1) > 20e3
        if far.any():
            return int(far.sum())
    return 0


@pytest.mark.parametrize('azimuth', [0.2, 2.9, 6.1])
@pytest.mark.parametrize('sectors', [1, 8])
@pytest.mark.parametrize(('memory', 'gap'), [(1.0, 1), (1.5, 1), (2.5, 2), (3.5, 3)])
def test_plot_waits_as_many_turns_wherever_it_is(azimuth, sectors, memory, gap) -> None:
    """However a turn is cut: so many turns later a second plot starts a track, not one later."""
    assert turning(azimuth, (3, 3 + gap), sectors, memory) == 1
    assert turning(azimuth, (3, 4 + gap), sectors, memory) == 0


def test_marks_of_a_cycle_wait_for_as_many_cycles() -> None:
    """The first one of a cycle for two more, as the last one does."""
    sonar = SonarTracker(with_values(SonarTrackerConfig(), {'clutter_density': 1e-3}))
    for cycle, marks in enumerate(([(0.0, 0.3)], [], [(0.0, 0.3)])):
        time, bearing = np.array([*marks, (9.5, 1.0 + 0.5 * cycle)]).T
        sonar.track(Bearings.of(10.0 * cycle + time, bearing))
    assert np.isclose(sonar.tracks.planes[0].average[:, 0], 0.3, atol=0.01).sum() == 1


@pytest.mark.parametrize(('method', 'first'), [('one_point', 1), ('two_point', 0)])
def test_one_point_starts_in_the_first_look(method: str, first: int) -> None:
    """The other needs two."""
    assert len(after([[HERE]], initiation__method=method).tracks) == first
    assert len(after([[HERE], [HERE]], initiation__method=method).tracks) == 1


def test_plot_of_a_new_track_hardly_starts_another() -> None:
    """A stray plot within reach of it one look later is a second contact only perhaps."""
    alone = after([[HERE], [BESIDE]], initiation__memory=1.5).tracks
    assert alone.existence_probability[0] > 0.99
    tracks = after([[HERE], [HERE], [HERE, BESIDE]], initiation__memory=1.5).tracks
    assert tracks.existence_probability[0] > 0.99
    assert (tracks.existence_probability[1:] < 0.2).all()


@pytest.mark.parametrize('method', ['one_point', 'two_point'])
def test_plots_without_height_start_nothing_in_three_dimensions(method: str) -> None:
    """A track needs to be somewhere; those with a height start as ever."""
    looks = [[(*HERE, np.nan), (2_000.0, 9_000.0, 500.0)]] * 3
    tracker = after(looks, initiation__method=method, sensor__dimensions=3)
    assert len(tracker.tracks) == 1
    assert np.isfinite(tracker.tracks.planes[1].mean).all()


def test_likeliest_of_new_tracks_has_the_only_place_left() -> None:
    """One that would be fast is less likely than one at rest, in whatever order they come."""
    slow, fast = [HERE, HERE], [(2_000.0, 9_000.0), (2_550.0, 9_000.0)]
    for first, second in ((slow, fast), (fast, slow)):
        looks = list(zip(first, second, strict=True))
        tracks = after(looks, max_tracks=1).tracks
        assert_allclose(tracks.planes[0].average[:, 0::2], [HERE])
        both = after(looks).tracks
        assert_allclose(both.planes[0].average[0, 0::2], HERE)
        assert both.id.tolist() == [1, 2]


@pytest.mark.parametrize('hits', [3, 4, 5])
def test_counted_plots_begin_with_the_two_of_the_start(hits: int) -> None:
    """So many of five: confirmed with the plot that makes them full, not before."""
    count = {'lifecycle': 'm_of_n', 'm_of_n__hits': hits}
    assert after([[HERE]] * (hits - 1), **count).tracks.confirmed.tolist() == [False]
    assert after([[HERE]] * hits, **count).tracks.confirmed.tolist() == [True]


@pytest.mark.parametrize('looks', [2, 5])
@pytest.mark.parametrize(
    ('method', 'hits'), [('one_point', 1), ('two_point', 1), ('two_point', 2)]
)
def test_counted_plots_of_a_start_may_be_enough(method: str, hits: int, looks: int) -> None:
    """A contact is confirmed with its plot M of N, also if that is the one that starts a track."""
    count = {'lifecycle': 'm_of_n', 'm_of_n__hits': hits, 'm_of_n__looks': looks}
    found = [[HERE]] * (1 if method == 'one_point' else 2)
    assert after(found, initiation__method=method, **count).tracks.confirmed.tolist() == [True]
    assert len(after([*found, []], initiation__method=method, **count).tracks) == 1


def test_existence_of_a_start_confirms_nothing() -> None:
    """However likely two plots are, a third one decides."""
    tracks = after([[HERE], [HERE]], existence__confirm=0.9).tracks
    assert tracks.existence_probability[0] > 0.99
    assert not tracks.confirmed[0]
