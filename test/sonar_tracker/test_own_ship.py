# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A sonar on a ship that turns, and that does not know its heading well."""

import numpy as np
import pytest

from benchmarks.sonar_data import preset
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.sensor import Sonar
from sonar_tracker.sensor_config import SensorConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings, Coverage
from tracking_core.config import with_values
from tracking_core.detection import detection_probability
from tracking_core.platform import Platform

RATE = 0.05  # rad/s, to port


def turning(yaw_variance):
    """Return samples of a ship that turns, every half second."""
    time = np.arange(0.0, 10.0, 0.5)
    half = 0.5 * RATE * time
    nothing = np.zeros(len(time))
    return Platform(
        time=time,
        position=np.zeros((len(time), 3)),
        orientation=np.stack([nothing, nothing, np.sin(half), np.cos(half)], axis=1),
        velocity=np.zeros((len(time), 3)),
        position_covariance=np.zeros((len(time), 3, 3)),
        yaw_variance=np.full(len(time), yaw_variance),
    )


def test_bearings_of_a_turning_ship_take_heading_and_its_doubt_at_their_own_time():
    """Between the samples the heading is turned evenly; variances of mark and heading add."""
    times, sd = np.array([1.1, 4.7, 9.3]), 0.01
    marks = Bearings.of(times, np.full(3, 0.3), bearing_sd=np.full(3, sd))
    pose = turning(yaw_variance=0.02**2).at(times)
    scan = Sonar(SensorConfig()).measure(marks, pose, Coverage(0.0, 10.0))
    np.testing.assert_allclose(scan.position[:, 0], 0.3 + RATE * times, atol=1e-9)
    np.testing.assert_allclose(scan.covariance[:, 0, 0], sd**2 + 0.02**2, rtol=1e-12)


def voyage(cycle):
    """Return a ship at 4 m/s that turns by 69 degrees in two minutes, every second of a cycle."""
    time = 10.0 * cycle + np.arange(0.0, 10.0, 1.0)
    every = np.arange(0.0, time[-1] + 0.5, 0.5)
    yaw = 0.01 * np.clip(every - 500.0, 0.0, 120.0)
    velocity = 4.0 * np.stack([np.cos(yaw), np.sin(yaw), 0.0 * yaw], axis=1)
    place, now = 0.5 * np.cumsum(velocity, axis=0), (2.0 * time).astype(int)
    turn = np.stack([0.0 * yaw, 0.0 * yaw, np.sin(0.5 * yaw), np.cos(0.5 * yaw)], axis=1)
    doubt = np.zeros((len(time), 3, 3)), np.zeros(len(time))
    return Platform(time, place[now], turn[now], velocity[now], *doubt), yaw[now[-1]]


def test_ids_live_through_a_turn_of_own_ship_with_no_parameters_but_the_noise():
    """Two vessels, 8 and 5 km off, whose bearings change at another rate after the turn."""
    rng = np.random.default_rng(1)
    sonar = SonarTracker(with_values(SonarTrackerConfig(), {'sensor.bearing_sd': 0.005}))
    for cycle in range(120):
        ship, yaw = voyage(cycle)
        time = ship.time[-1]
        vessels = np.array([[8000.0 - 2.0 * time, 4000.0], [1000.0, time - 5000.0]])
        line = vessels - ship.position[-1, :2]
        bearing = np.arctan2(line[:, 1], line[:, 0]) - yaw + 0.005 * rng.standard_normal(2)
        tracks = sonar.track(Bearings.of(np.full(2, time), bearing), ship)
        if cycle == 40:
            before = tracks.id[tracks.confirmed]
    assert len(before) == 2
    np.testing.assert_array_equal(tracks.id[tracks.confirmed], before)


def test_gates_allow_for_the_doubt_of_the_heading():
    """The heading is off by 2 degrees anew in each cycle: hardly a look is lost."""
    rng, doubt = np.random.default_rng(3), np.radians(2.0)
    config = with_values(SonarTrackerConfig(), {'sensor.bearing_sd': 0.002})
    sonar, true = SonarTracker(config), np.array([-2.0, -0.5, 0.4, 1.9])
    misses = []
    for cycle in range(120):
        time = np.array([4.0 * cycle])
        half = 0.5 * rng.normal(0.0, doubt)
        ship = Platform(
            time=time,
            position=np.zeros((1, 3)),
            orientation=np.array([[0.0, 0.0, np.sin(half), np.cos(half)]]),
            velocity=np.zeros((1, 3)),
            position_covariance=np.zeros((1, 3, 3)),
            yaw_variance=np.full(1, doubt**2),
        )
        marks = Bearings.of(np.repeat(time, 4), true + 0.002 * rng.standard_normal(4))
        tracks = sonar.track(marks, ship)
        if cycle >= 30:
            misses.append(tracks.misses[tracks.confirmed] > 0)
    assert tracks.confirmed.sum() == 4
    assert np.concatenate(misses).mean() < 0.03


def test_a_sonar_beside_the_keel_is_where_the_turned_ship_has_it():
    """10 m ahead and 3 m to port of own ship's origin, which heads 0.05 rad/s times 9.5 s."""
    config = with_values(SonarTrackerConfig(), {'sensor.mount.x': 10.0, 'sensor.mount.y': 3.0})
    sonar, yaw = SonarTracker(config), RATE * 9.5
    sonar.track(Bearings.of(np.full(1, 9.5), np.zeros(1)), turning(yaw_variance=0.0))
    x, y = 10.0 * np.cos(yaw) - 3.0 * np.sin(yaw), 10.0 * np.sin(yaw) + 3.0 * np.cos(yaw)
    np.testing.assert_allclose(sonar.sensor_position, (x, y, 0.0), atol=1e-12)


def test_gates_are_for_marks_as_sure_as_they_say_and_for_the_heading():
    """Expected of the next mark: the median of the told variances, and that of the heading."""
    sonar = SonarTracker(SonarTrackerConfig())
    marks = Bearings.of(np.full(3, 9.0), np.zeros(3), bearing_sd=np.array([0.01, 0.02, 0.05]))
    sonar.track(marks, turning(yaw_variance=0.03**2))
    expected = sonar.core.setup.sensor.noise(np.zeros((1, 1)), sonar.coverage)
    np.testing.assert_allclose(expected, [[[0.02**2 + 0.03**2]]], rtol=1e-9)


def test_contact_to_port_keeps_its_id_where_marks_are_counted_to_starboard():
    """Of each mark's two tracks that of the contact goes on through the turn, the other ends."""
    rng = np.random.default_rng(2)
    values = {
        'sensor.array': 'linear', 'sensor.both_sides': True, 'sensor.bearing_sd': 0.003,
    }  # fmt: skip
    sonar = SonarTracker(with_values(SonarTrackerConfig(), values))
    on_contact, before = set(), set()
    for cycle in range(120):
        ship, yaw = voyage(cycle)
        pose = ship.at(ship.time[-1:])
        line = np.array([3000.0 - 2.0 * ship.time[-1], 8000.0]) - pose.position[0, :2]
        bearing = np.arctan2(line[1], line[0])
        off = abs(bearing - yaw) + 0.003 * rng.standard_normal()
        tracks = sonar.track(Bearings.of(ship.time[-1:], np.array([-off])), ship)
        sure = tracks.confirmed
        near = np.abs(np.cos(bearing_states(tracks).bearing - bearing) - 1.0) < 0.001
        if cycle == 45:
            assert (near & sure).sum() == 1
            assert sure.sum() == 2  # the contact, and its image to starboard
            before = set(tracks.id[sure].tolist())
        if cycle > 45:
            on_contact |= set(tracks.id[sure & near].tolist())
    assert len(on_contact) == 1
    assert on_contact <= before
    assert before & set(tracks.id.tolist()) == on_contact


@pytest.mark.parametrize('values', [{}, preset('passive_linear_array')])
def test_marks_that_tell_half_their_sd_start_no_second_tracks(values):
    """Six contacts in 10 minutes: what falls outside a gate has no track yet."""
    rng = np.random.default_rng(4)
    sonar = SonarTracker(with_values(SonarTrackerConfig(), values))
    true, ids = np.radians([-150.0, -130.0, -105.0, -80.0, -55.0, -30.0]), set()
    sd = sonar.config.sensor.bearing_sd
    for cycle in range(300):
        heard = true[rng.random(6) < 0.9]
        marks = Bearings.of(
            np.full(len(heard), 2.0 * cycle), heard + sd * rng.standard_normal(len(heard)),
            bearing_sd=np.full(len(heard), 0.5 * sd), stamp=2.0 * cycle,
        )  # fmt: skip
        tracks = sonar.track(marks)
        ids |= set(tracks.id[tracks.confirmed].tolist())
    assert len(ids) <= 8


def test_contact_keeps_its_id_through_the_blind_sector() -> None:
    """Deaf for 60 degrees astern, own ship turns away from a contact for ten looks and back."""
    values = {**preset('direction_finder'), 'sensor.sector_width': np.radians(300.0)}
    sonar, rng = SonarTracker(with_values(SonarTrackerConfig(), values)), np.random.default_rng(2)
    ids = []
    time = 10.0 * np.arange(60)
    yaw = np.where((time >= 300.0) & (time < 400.0), np.pi, 0.0)
    nothing = np.zeros((len(time), 3))
    turn = np.stack([0.0 * yaw, 0.0 * yaw, np.sin(0.5 * yaw), np.cos(0.5 * yaw)], axis=1)
    ship = Platform(time, nothing, turn, nothing, np.zeros((60, 3, 3)), np.zeros(60))
    for now, heading in zip(time, yaw, strict=True):
        heard = np.zeros(0) if heading else rng.normal(0.1, 0.0175, 1)
        marks = Bearings.of(np.full(len(heard), now), heard, stamp=now)
        tracks = sonar.track(marks, ship)
        ids.append(tracks.id[tracks.confirmed].tolist())
    assert len(ids[29]) == 1
    assert ids[-1] == ids[29]


@pytest.mark.parametrize('lifecycle', ['existence', 'm_of_n', 'error_ratio'])
def test_blind_looks_are_no_misses(lifecycle: str) -> None:
    """Of fifteen looks in the blind sector only the last one changes anything: the track ends."""
    values = {'lifecycle': lifecycle, 'sensor.sector_width': 4.0, 'sensor.bearing_sd': 0.01}
    sonar = SonarTracker(with_values(SonarTrackerConfig(), values))
    time = 10.0 * np.arange(36)
    yaw = np.where(time < 200.0, 0.0, np.pi)
    nothing = np.zeros((len(time), 3))
    turn = np.stack([0.0 * yaw, 0.0 * yaw, np.sin(0.5 * yaw), np.cos(0.5 * yaw)], axis=1)
    ship = Platform(time, nothing, turn, nothing, np.zeros((36, 3, 3)), np.zeros(36))
    alive = []
    for now, heading in zip(time, yaw, strict=True):
        heard = np.zeros(int(not heading))
        tracks = sonar.track(Bearings.of(heard + now, heard, stamp=now), ship)
        alive.append(len(tracks))
        if alive[-1]:
            last = tracks
    assert alive[20:] == 14 * [1] + 2 * [0]
    np.testing.assert_array_equal(
        [last.hits, last.misses, last.outside, last.coasted], [[20], [0], [14], [14]]
    )
    usual = np.array([0.9])
    np.testing.assert_array_equal(detection_probability(last, usual, np.zeros(1)), usual)
