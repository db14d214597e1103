# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A rotating antenna: plots at their own times, the seam between messages, sectors, coverage."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest
from scipy.spatial.transform import Rotation

from radar_tracker.build import build_setup
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.sensor import Radar
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.batches import Coverage, Plots, Tracks
from tracking_core.config import with_values
from tracking_core.platform import Platform
from tracking_core.rows import take
from tracking_core.tracker import Tracker
from tracking_tools.scenarios import Contact, Legs, NORTH, Scenario, SimulatedRadar

PERIOD = 4.0
RADAR = SimulatedRadar(
    period=PERIOD, rotation='clockwise', range_sd=20.0, azimuth_sd=0.003,
    detection_probability=1.0, range_limits=(500.0, 40_000.0),
)  # fmt: skip
CONFIG = with_values(
    RadarTrackerConfig(),
    {
        'sensor.range_sd': 20.0,
        'sensor.azimuth_sd': 0.003,
        'sensor.range_max': 40_000.0,
        'motion.horizontal.acceleration_sd': [0.3, 5.0],
        'motion.horizontal.sojourn_time': [120.0, 30.0],
        'initiation.speed_max': 400.0,
        'clutter_density': 1e-6,
        'scan.period': PERIOD,
    },
)
AT_REST = Platform(
    np.zeros(1), np.zeros((1, 3)), np.array([[0.0, 0.0, 0.0, 1.0]]), np.zeros((1, 3)),
    np.zeros((1, 3, 3)), np.zeros(1), max_extrapolation=1e9,
)  # fmt: skip
both_ways = pytest.mark.parametrize('rotation', ['clockwise', 'anticlockwise'])


def at(azimuth: float, distance: float, speed: float = 0.0, course: float = 0.0, ident: int = 1):
    """One contact."""
    place = (distance * np.cos(azimuth), distance * np.sin(azimuth), 0.0)
    return Contact(ident, Legs(place, speed, course))


def around(count: int = 6, speed: float = 150.0, first: int = 1) -> tuple[Contact, ...]:
    """Contacts in all directions."""
    rng = np.random.default_rng(2)
    return tuple(
        at(2.4 * k + 0.4, 12_000.0 + 2_000.0 * k, speed, rng.uniform(-np.pi, np.pi), first + k)
        for k in range(count)
    )


def followed(
    radar: SimulatedRadar, contacts, looks: int, sectors: int = 1, **values
) -> RadarTracker:
    """Return a tracker after some turns."""
    tracker = RadarTracker(
        with_values(CONFIG, {k.replace('__', '.'): v for k, v in values.items()})
    )
    scene = Scenario(radar, contacts, looks * radar.period)
    for plots, _ in messages(scene, np.random.default_rng(7), sectors):
        tracker.track(plots)
    return tracker


def by_place(tracks: Tracks) -> Tracks:
    """Return the confirmed tracks in order of their x."""
    tracks = take(tracks, tracks.confirmed)
    return take(tracks, np.argsort(tracks.planes[0].moments()[0][:, 0]))


@both_ways
@pytest.mark.parametrize('speed', [0.0, 25.0])
def test_seam_keeps_ids_and_counts_no_misses(rotation: str, speed: float) -> None:
    """Contacts on the cut of the messages, 100 turns: one id each, a plot in every pass."""
    cut = tuple(
        at(NORTH, distance, speed, course, k + 1)
        for k, (distance, course) in enumerate(
            [(9_000.0, 0.0), (15_000.0, np.pi), (20_000.0, 1.5)]
        )
    )
    tracker = RadarTracker(CONFIG)
    scene = Scenario(
        replace(RADAR, rotation=rotation), (*cut, *around(3, 20.0, first=4)), 102 * PERIOD
    )
    ids, misses, counts = set(), 0, []
    for k, (plots, _) in enumerate(messages(scene, np.random.default_rng(7))):
        tracks = tracker.track(plots)
        confirmed = take(tracks, tracks.confirmed)
        ids |= set(confirmed.id.tolist())
        misses += int(confirmed.misses.sum())
        counts += [len(confirmed)] if k > 5 else []
    assert len(ids) == 6
    assert set(counts) == {6}
    assert misses == 0
    # A contact that sits on the cut is passed once a turn, whatever the messages hold.
    assert confirmed.hits.min() >= 100
    assert confirmed.hits.max() <= 102


def test_seam_really_splits_and_doubles_passes() -> None:
    """The scene above is worth its name: messages hold a contact twice, and not at all."""
    scene = Scenario(RADAR, (at(NORTH, 9_000.0),), 100 * PERIOD)
    held = [len(plots) for plots, _ in messages(scene, np.random.default_rng(7))]
    crossing = Scenario(RADAR, (at(NORTH, 9_000.0, 25.0, 0.0), at(NORTH, 9_000.0, 25.0, np.pi, 2)),
                        100 * PERIOD)  # fmt: skip
    moving = [len(plots) for plots, _ in messages(crossing, np.random.default_rng(7))]
    assert min(held + moving) < max(held + moving)


@both_ways
def test_fast_contacts_beside_the_cut_miss_no_pass(rotation: str) -> None:
    """Away from the radar at 250 m/s: a turn later they are out of the gate that they were in."""
    sense = 1.0 if rotation == 'clockwise' else -1.0
    beside = tuple(
        at(NORTH + sense * offset, 5_000.0 + 2_500.0 * k, 250.0, NORTH + sense * offset, k + 1)
        for k, offset in enumerate([0.001, 0.004, 0.008])
    )
    tracks = followed(replace(RADAR, rotation=rotation), beside, 26).tracks
    assert_array_equal(tracks.hits, 25)
    assert tracks.id.max() == len(tracks) == len(beside)


def test_contacts_beside_the_cut_do_not_take_turns_at_waiting() -> None:
    """Missed now and then, a gate is wider in the next look; it waits, or does not, for long."""
    beside = tuple(
        at(NORTH + offset, 9_000.0 + 2_000.0 * k, ident=k + 1)
        for k, offset in enumerate(np.linspace(0.002, 0.05, 13))
    )
    scene = Scenario(replace(RADAR, detection_probability=0.8), beside, 200 * PERIOD)
    tracker, last, waits = RadarTracker(CONFIG), {}, []
    for plots, _ in messages(scene, np.random.default_rng(7)):
        tracks = tracker.track(plots)
        now = dict(zip(tracks.id.tolist(), tracks.time.tolist(), strict=True))
        waits += [name for name, time in now.items() if time == last.get(name)]
        last = now
    assert len(tracks) == len(beside)
    assert max(waits.count(name) for name in now) <= 5  # 25 and more without a margin


@both_ways
@pytest.mark.parametrize('sectors', [3, 12])
def test_sectors_give_the_tracks_of_full_turns(rotation: str, sectors: int) -> None:
    """However the turns are cut: the same tracks, each with a plot in every pass."""
    radar = replace(RADAR, rotation=rotation)
    contacts = around(speed=80.0)
    whole = followed(radar, contacts, 40)
    parts = followed(radar, contacts, 40, sectors, scan__assembly='sector')
    one, other = by_place(whole.tracks), by_place(parts.tracks)
    assert len(one) == len(other) == 6
    # Sectors start tracks a turn later at most, for the antenna is learnt from the first turn;
    # at the end a track on the cut may wait for its pass to be over.
    passes = np.rint((other.time - other.birth_time) / PERIOD)
    assert_array_equal(other.hits, passes + 2)
    assert (other.hits >= 37).all()
    same = np.abs(other.time - one.time) < 0.01 * PERIOD
    assert same.sum() >= 5
    m, n = one.planes[0].moments()[0][same], other.planes[0].moments()[0][same]
    sd = np.sqrt(np.einsum('tnn->tn', one.planes[0].moments()[1]))[same, 0::2]
    moved = m[:, 0::2] + (other.time - one.time)[same, None] * m[:, 1::2]
    assert (np.abs(n[:, 0::2] - moved) < 0.02 * sd).all()


def test_sectors_can_be_collected_to_turns() -> None:
    """`rotation` waits for a full turn."""
    tracker = followed(RADAR, around(), 20, 4, scan__assembly='rotation')
    assert tracker.tracks.confirmed.sum() == 6
    assert (tracker.tracks.hits[tracker.tracks.confirmed] >= 15).all()
    assert (tracker.tracks.misses[tracker.tracks.confirmed] == 0).all()


def single_plots(sensed, contact: int, values) -> Tracks:
    """Return the track of one contact from scans of one plot each, without any antenna."""
    config = with_values(CONFIG, values)
    sensor = Radar(config.sensor, dimensions=2, is_polar=True)
    tracker = Tracker(build_setup(config, sensor))
    for plots, scan in sensed:
        for row in np.flatnonzero(scan.contact == contact):
            time = plots.time[row : row + 1]
            one = Plots.polar(time, plots.range[row : row + 1], plots.azimuth[row : row + 1])
            coverage = Coverage(time[0], time[0])
            tracker.step(sensor.measure(one, AT_REST.at(time), coverage, 1e5))
    return tracker.tracks


def test_every_plot_is_used_at_its_own_time() -> None:
    """Full turns give the states that single-plot scans give, at 390 m/s and 4 s a turn."""
    radar = replace(RADAR, range_sd=5.0, azimuth_sd=0.0005)
    values = {'sensor.range_sd': 5.0, 'sensor.azimuth_sd': 0.0005}
    contacts = around(5, 390.0)
    scene = Scenario(radar, contacts, 15 * PERIOD)
    sensed = list(messages(scene, np.random.default_rng(7)))
    tracker = RadarTracker(with_values(CONFIG, values))
    for plots, _ in sensed:
        tracker.track(plots)
    m, P = tracker.tracks.planes[0].moments()
    assert len(m) == 5
    compared = 0
    for contact in contacts:
        alone = single_plots(sensed, contact.id, values)
        x, _ = alone.planes[0].moments()
        near = np.linalg.norm(m[:, 1::2] - x[0, 1::2], axis=1).argmin()
        sd = np.sqrt(np.diag(P[near]))
        position, velocity = contact.trajectory.at(float(tracker.tracks.time[near]))
        true = np.stack([position[:2], velocity[:2]], axis=1).ravel()
        assert_allclose((m[near] - true) / sd, 0.0, atol=4.0)
        ahead = tracker.tracks.time[near] - alone.time[0]
        if abs(ahead) < 0.1:  # not waiting for a pass across the cut to be over
            moved = x[0] + ahead * np.array([x[0, 1], 0.0, x[0, 3], 0.0])
            assert_allclose((m[near] - moved) / sd, 0.0, atol=0.03)
            compared += 1
    assert compared >= 3


def test_coverage_outside_is_not_missed() -> None:
    """A track that leaves the sector is not counted down: only its lifetime passes."""
    sector = replace(RADAR, azimuth_coverage=(0.0, np.pi))
    values = {'sensor.sector_centre': 0.5 * np.pi, 'sensor.sector_width': np.pi}
    leaving = Contact(1, Legs((12_000.0, 600.0, 0.0), 100.0, -0.5 * np.pi))
    contacts = (leaving, *(c for c in around(9) if c.trajectory.position[1] > 6_000.0))
    tracker = RadarTracker(with_values(CONFIG, values))
    scene = Scenario(sector, contacts, 16 * PERIOD)
    lives = []
    for plots, _ in messages(scene, np.random.default_rng(7)):
        tracks = tracker.track(plots)
        m = tracks.planes[0].moments()[0]
        outside = m[:, 2] < -30.0
        lives += [(tracks.existence_probability[outside], tracks.time[outside])]
    gone = [(r[0], t[0]) for r, t in lives if len(r) == 1]
    assert len(gone) >= 3
    r, time = np.array(gone).T
    decay = np.exp(-(time - time[0]) / CONFIG.existence.lifetime)
    assert_allclose(r, r[0] * decay, rtol=1e-6)
    assert r[0] > 0.9
    assert len(lives[-1][0]) == 0
    assert tracker.tracks.confirmed.sum() == len(contacts) - 1


def test_coverage_inside_a_miss_counts() -> None:
    """The same track inside the sector and unseen fades within a few looks."""
    tracker = followed(RADAR, around(3), 10)
    before = tracker.tracks.existence_probability
    for k in range(10, 13):
        empty = Plots.polar(np.zeros(0), np.zeros(0), np.zeros(0))
        tracker.track(replace(empty, stamp=k * PERIOD))
    assert (tracker.tracks.existence_probability < 0.9 * before).all()
    assert (tracker.tracks.misses >= 2).all()


def test_platform_moves_under_the_tracks() -> None:
    """Own ship sails and turns; a contact at rest stays where it is."""
    rng, rest = np.random.default_rng(9), np.array([[8_000.0, 3_000.0], [-6_000.0, 5_000.0],
                                                    [2_000.0, -9_000.0]])  # fmt: skip
    config = with_values(CONFIG, {'scan.period': 0.0, 'sensor.mount.yaw': 0.2,
                                  'sensor.mount.x': 10.0})  # fmt: skip
    tracker, platform = RadarTracker(config), Platform.empty()
    for k in range(20):
        time, yaw = 4.0 * k, 0.02 * k
        own = np.array([8.0 * time, 0.0, 0.0])
        platform = platform.add(
            Platform(
                np.array([time]),
                own[None],
                Rotation.from_euler('z', yaw).as_quat().reshape(1, 4),
                np.array([[8.0, 0.0, 0.0]]),
                np.zeros((1, 3, 3)),
                np.array([1e-8]),
            )
        )
        antenna = own[:2] + 10.0 * np.array([np.cos(yaw), np.sin(yaw)])
        offset = rest - antenna
        azimuth = np.arctan2(offset[:, 1], offset[:, 0]) - yaw - 0.2 + rng.normal(0.0, 0.003, 3)
        distance = np.linalg.norm(offset, axis=1) + rng.normal(0.0, 20.0, 3)
        plots = Plots.polar(np.full(3, time), distance, azimuth)
        tracker.track(replace(plots, stamp=time), platform)
    m, P = by_place(tracker.tracks).planes[0].moments()
    true = rest[np.argsort(rest[:, 0])]
    assert len(m) == 3
    sd = np.sqrt(np.einsum('tnn->tn', P))
    assert (np.abs(m[:, 0::2] - true) < 4.0 * sd[:, 0::2]).all()
    assert (np.abs(m[:, 1::2]) < 4.0 * sd[:, 1::2]).all()
    assert sd[:, 0::2].max() < 40.0
