# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The whole tracker on small scenes of a sensor that looks everywhere at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.association import ASSOCIATORS
from tracking_core.batches import Plots, Tracks
from tracking_core.config import with_values
from tracking_core.rows import take
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

RADAR = SimulatedRadar(
    period=4.0, rotation='staring', range_sd=20.0, azimuth_sd=0.002, detection_probability=0.95,
    range_limits=(500.0, 40_000.0),
)  # fmt: skip
CONFIG = with_values(
    RadarTrackerConfig(),
    {
        'sensor.range_sd': 20.0,
        'sensor.azimuth_sd': 0.002,
        'sensor.detection_probability': 0.95,
        'sensor.range_max': 40_000.0,
        'motion.horizontal.acceleration_sd': [0.3, 5.0],
        'motion.horizontal.sojourn_time': [120.0, 30.0],
        'initiation.speed_max': 300.0,
        'clutter_density': 1e-6,
    },
)


def contacts(count: int, seed: int = 5, speed: float = 150.0) -> tuple[Contact, ...]:
    """Straight movers, well apart on a spiral."""
    rng = np.random.default_rng(seed)
    made = []
    for k in range(count):
        angle, distance = 2.4 * k + 0.3, 9_000.0 + 1_500.0 * k
        position = (distance * np.cos(angle), distance * np.sin(angle), 0.0)
        made.append(Contact(k + 1, Legs(position, speed, rng.uniform(-np.pi, np.pi))))
    return tuple(made)


def scene(count: int = 4, looks: int = 15, seed: int = 1, **radar) -> list[Plots]:
    """All messages of a scene."""
    scenario = Scenario(replace(RADAR, **radar), contacts(count), 4.0 * looks)
    return [plots for plots, _ in messages(scenario, np.random.default_rng(seed))]


def followed(plots: list[Plots], **values) -> RadarTracker:
    """Return a tracker after these messages."""
    tracker = RadarTracker(
        with_values(CONFIG, {k.replace('__', '.'): v for k, v in values.items()})
    )
    for message in plots:
        tracker.track(message)
    return tracker


def by_place(tracks: Tracks) -> Tracks:
    """Return the confirmed tracks in order of their x."""
    tracks = take(tracks, tracks.confirmed)
    return take(tracks, np.argsort(tracks.planes[0].moments()[0][:, 0]))


def assert_same(first: Tracks, second: Tracks) -> None:
    """Equal in all but id, to rounding."""
    assert len(first) == len(second) > 0
    for one, other in zip(first.planes, second.planes, strict=True):
        assert_allclose(one.moments()[0], other.moments()[0], rtol=1e-9, atol=1e-6)
        assert_allclose(one.mode_probability, other.mode_probability, atol=1e-9)
    assert_allclose(first.existence_probability, second.existence_probability, atol=1e-9)
    assert_array_equal(first.hits, second.hits)


def error_of(tracker: RadarTracker, count: int, part: slice = slice(0, None, 2)):
    """Distance of each contact's state to the nearest confirmed track's."""
    tracks = take(tracker.tracks, tracker.tracks.confirmed)
    mean = tracks.planes[0].moments()[0][:, part]
    errors = []
    for contact in contacts(count):
        position, velocity = contact.trajectory.at(float(tracks.time.max()))
        true = np.array([position[0], velocity[0], position[1], velocity[1]])[part]
        errors.append(np.linalg.norm(mean - true, axis=1).min())
    return np.array(errors)


@pytest.mark.parametrize('association', ASSOCIATORS)
@pytest.mark.parametrize('lifecycle', ['existence', 'm_of_n'])
@pytest.mark.parametrize('method', ['two_point', 'one_point'])
def test_tracker_finds_every_contact(association: str, lifecycle: str, method: str) -> None:
    """Four contacts in light clutter: four confirmed tracks, near the truth, under every menu."""
    plots = scene(clutter_per_turn=0.3)
    tracker = followed(
        plots, association=association, lifecycle=lifecycle, initiation__method=method
    )
    assert tracker.tracks.confirmed.sum() == 4
    assert (error_of(tracker, 4) < 120.0).all()
    assert (error_of(tracker, 4, slice(1, None, 2)) < 25.0).all()


def test_tracker_takes_empty_scans() -> None:
    """No plots ever, no plots for a while, none any more: tracks come, wait, and go."""
    nothing = [replace(plots, stamp=plots.stamp) for plots in scene(0, 3)]
    assert len(followed(nothing).tracks) == 0
    tracker = followed(scene(4, 12))
    last = tracker.state.time
    lives = []
    for k in range(1, 12):
        empty = replace(take(scene(4, 1)[0], slice(0, 0)), stamp=last + 4.0 * k)
        lives.append(len(tracker.track(empty)))
    assert lives[0] == 4
    assert lives[-1] == 0


def test_tracker_does_not_mind_the_order_of_plots() -> None:
    """Permuting the plots of every scan changes nothing but the order of new tracks."""
    plots = scene(6, clutter_per_turn=5.0)
    rng = np.random.default_rng(3)
    shuffled = [replace(take(p, rng.permutation(len(p))), stamp=p.stamp) for p in plots]
    assert_same(by_place(followed(plots).tracks), by_place(followed(shuffled).tracks))


def test_tracker_treats_distant_scenes_apart() -> None:
    """Two scenes in one message give the tracks that each alone gives."""
    # A quarter turn keeps the ranges, and so the volume that densities are per.
    here = scene(2, seed=2)
    there = [replace(p, azimuth=p.azimuth + 1.2) for p in scene(2, seed=2)]
    both = [
        replace(
            Plots.polar(
                np.concatenate([a.time, b.time]),
                np.concatenate([a.range, b.range]),
                np.concatenate([a.azimuth, b.azimuth]),
            ),
            stamp=a.stamp,
        )
        for a, b in zip(here, there, strict=True)
    ]
    together = by_place(followed(both).tracks)
    alone = [by_place(followed(part).tracks) for part in (here, there)]
    assert len(together) == 4
    x = np.concatenate([tracks.planes[0].moments()[0] for tracks in alone])
    x = x[np.argsort(x[:, 0])]
    assert_allclose(together.planes[0].moments()[0], x, rtol=1e-9, atol=1e-6)


def test_tracker_leaves_the_clutter_estimate_near_the_truth() -> None:
    """With the density unknown, 40 false plots a look are counted to a tenth."""
    plots = scene(5, 60, clutter_per_turn=40.0)
    tracker, seen = followed(plots[:10], clutter_density=0.0), []
    for message in plots[10:]:
        tracker.track(message)
        seen.append(tracker.state.clutter.density)
    truth = 40.0 / (39_500.0 * 2.0 * np.pi)
    assert np.mean(seen) == pytest.approx(truth, rel=0.1)


def test_range_rate_improves_the_velocity() -> None:
    """Measured to 1 m/s, after three looks the velocity along the line of sight is better."""
    with_rate = scene(6, 3, range_rate_sd=1.0, detection_probability=1.0)
    without = [replace(p, range_rate=np.full(len(p), np.nan)) for p in with_rate]
    sd = []
    for plots in (with_rate, without):
        tracker = followed(plots, sensor__range_rate_sd=1.0, sensor__azimuth_sd=0.0005)
        m, P = tracker.tracks.planes[0].moments()
        sight = m[:, 0::2] / np.linalg.norm(m[:, 0::2], axis=1, keepdims=True)
        sd.append(np.sqrt(np.einsum('ti,tij,tj->t', sight, P[:, 1::2, 1::2], sight)))
        truth = [c.trajectory.at(float(tracker.tracks.time[0]))[1][:2] for c in contacts(6)]
        gap = np.linalg.norm(m[:, None, 1::2] - np.array(truth), axis=2).argmin(axis=1)
        error = ((m[:, 1::2] - np.array(truth)[gap]) * sight).sum(axis=1)
        assert (np.abs(error) < 4.0 * sd[-1]).all()
        assert len(m) == 6
    assert np.mean(sd[0]) < 0.5 * np.mean(sd[1])


def test_range_rate_rows_without_are_harmless() -> None:
    """Plots with NaN beside plots that have it: all contacts are held, nothing is NaN."""
    plots = scene(6, 15, range_rate_sd=1.0)
    mixed = [
        replace(p, range_rate=np.where(np.arange(len(p)) % 2, np.nan, p.range_rate)) for p in plots
    ]
    tracker = followed(mixed, sensor__range_rate_sd=1.0)
    assert tracker.tracks.confirmed.sum() == 6
    assert np.isfinite(tracker.tracks.planes[0].mean).all()
    absent = [replace(p, range_rate=np.full(len(p), np.nan)) for p in plots]
    never = scene(6, 15)
    assert_same(by_place(followed(absent).tracks), by_place(followed(never).tracks))


def test_height_is_tracked_in_its_own_plane() -> None:
    """A 3-D radar gives z and vz, also when some plots lack the elevation."""
    climbing = tuple(
        replace(
            c, trajectory=Legs((*c.trajectory.position[:2], 4_000.0), 150.0, 2.0, climb_rate=v)
        )
        for c, v in zip(contacts(3), (10.0, 0.0, -8.0), strict=True)
    )
    radar = replace(RADAR, elevation_sd=0.002, detection_probability=1.0)
    rng, tracker = np.random.default_rng(4), RadarTracker(CONFIG)
    for k, (plots, _) in enumerate(messages(Scenario(radar, climbing, 100.0), rng)):
        lacks = k > 5 and k % 3 == 0
        tracker.track(replace(plots, elevation=np.full(3, np.nan)) if lacks else plots)
    tracks = take(tracker.tracks, tracker.tracks.confirmed)
    assert len(tracks) == 3
    assert tracks.gate_size.shape == (3, 3)
    level, (m, P) = tracks.planes[0].moments()[0], tracks.planes[1].moments()
    for contact in climbing:
        position, velocity = contact.trajectory.at(float(tracks.time[0]))
        t = np.linalg.norm(level[:, 0::2] - position[:2], axis=1).argmin()
        assert abs(m[t, 0] - position[2]) < 4.0 * np.sqrt(P[t, 0, 0]) < 600.0
        assert abs(m[t, 1] - velocity[2]) < 4.0 * np.sqrt(P[t, 1, 1])


def test_max_tracks_refuses_and_reports() -> None:
    """No more tracks than allowed; the rest is counted, and uses up no ids."""
    refused, started, seen = 0, 0, set()
    tracker = RadarTracker(with_values(CONFIG, {'max_tracks': 4}))
    for number, message in enumerate(scene(6, 10)):
        if number == 5:  # make room for one
            tracker.drop_track(int(tracker.tracks.id[0]))
        tracks = tracker.track(message)
        assert len(tracks) <= 4
        refused += tracker.state.report.refused
        started += tracker.state.report.started
        seen |= set(tracks.id.tolist())
    assert refused >= 2
    assert seen == set(range(1, started + 1))
    assert started > 4


def test_duplicates_are_merged() -> None:
    """A second track on a contact goes, its id is reported, the old one stays."""
    plots = scene(4, 20, detection_probability=1.0)
    tracker = followed(plots[:12], merge__looks=1, merge__distance=1.0)
    first = tracker.tracks
    place = first.planes[0].moments()[0][0, 0::2]
    double = tracker.start_track(place, float(first.time[0]))
    merged, count = [], 0
    for message in plots[12:]:
        tracker.track(message)
        merged += tracker.state.report.deleted.tolist()
        count += tracker.state.report.merged
    assert merged == [double]
    assert count == 1
    assert_array_equal(tracker.tracks.id, first.id)


def test_ids_are_never_used_twice() -> None:
    """Tracks started by plots, by hand and after a reset all have new ids."""
    plots = scene(4, 8)
    tracker = followed(plots)
    old = set(tracker.tracks.id.tolist())
    mine = tracker.start_track(np.array([30_000.0, 0.0]), tracker.state.time)
    assert mine not in old
    assert tracker.tracks.confirmed[tracker.tracks.id == mine].all()
    assert tracker.drop_track(mine)
    assert not tracker.drop_track(mine)
    tracker.reset()
    assert len(tracker.tracks) == 0
    for message in plots:
        tracker.track(message)
    assert min(tracker.tracks.id) > max(old)


def test_broken_covariances_are_dropped_and_counted() -> None:
    """A track whose covariance is no longer positive definite is deleted; others live."""
    tracker = followed(scene(4, 10))
    inner = tracker.core
    plane = inner.state.tracks.planes[0]
    covariance = plane.covariance.copy()
    covariance[1, :, 0, 1] = covariance[1, :, 1, 0] = 3.0 * np.sqrt(
        covariance[1, :, 0, 0] * covariance[1, :, 1, 1]
    )
    tracks = replace(inner.state.tracks, planes=(replace(plane, covariance=covariance),))
    inner.state = replace(inner.state, tracks=tracks)
    gone = tracks.id[1]
    tracker.track(replace(take(scene(4, 1)[0], slice(0, 0)), stamp=40.0))
    assert tracker.state.report.broken == 1
    assert gone not in tracker.tracks.id
    assert len(tracker.tracks) == 3


def test_reconfigure_keeps_the_tracks() -> None:
    """Live parameters hold from the next message on."""
    tracker = followed(scene(4, 10))
    before = tracker.tracks.id
    tracker.reconfigure(with_values(CONFIG, {'sensor.detection_probability': 0.5}))
    assert_array_equal(tracker.tracks.id, before)
    tracker.track(replace(take(scene(4, 1)[0], slice(0, 0)), stamp=40.0))
    assert (tracker.tracks.existence_probability > 0.9).all()
