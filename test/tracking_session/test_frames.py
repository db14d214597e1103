# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Frames are learnt or refused, never guessed in silence."""

import pytest

from msg_adapters.bad_message import BadMessage
from radar_tracker.config import ScanConfig
from radar_tracker.sensor_config import MountConfig, SensorConfig
from tracking_session.axes import check_axes, check_places
from tracking_session.frames import TrackingFrame


@pytest.fixture
def said():
    """Collect what is announced."""
    return []


def test_stationary_sensor_gives_its_frame_and_says_so_once(said):
    """With nothing set, the frame of the plots is the tracking frame."""
    frame = TrackingFrame('', False, said.append)
    frame.check_plots('radar')
    frame.check_plots('radar')
    assert frame.name == 'radar'
    assert not frame.needs_platform
    assert len(said) == 1


@pytest.mark.parametrize('has_ship', [False, True])
def test_frame_without_a_name_is_learnt_once_too(said, has_ship):
    """As of drivers that leave frame_id empty: plots of another sensor are refused there, too."""
    frame = TrackingFrame('', False, said.append)
    for time in range(3):
        frame.check_plots('')
        if has_ship:
            frame.has_ship = True  # it has been believed
            frame.check_ownship('', float(time))
    with pytest.raises(BadMessage, match="'other', expected ''"):
        frame.check_plots('other')
    assert len(said) == 1
    assert 'viewers show nothing' in said[0]


def test_places_in_the_tracking_frame_are_used_as_they_are(said):
    """Also when own ship is known."""
    frame = TrackingFrame('map', False, said.append)
    frame.check_ownship('map', 0.0)
    frame.check_plots('map')
    assert not frame.needs_platform
    assert not frame.tells_true('frame')
    assert said == []


def test_directions_in_the_tracking_frame_are_true_ones_from_own_ship(said):
    """A north-up radar on a ship is where the ship is, not at the origin."""
    frame = TrackingFrame('map', False, said.append)
    frame.check_plots('map', polar=True)
    assert not frame.needs_platform  # without own ship the sensor stands there
    for time in (0.0, 0.1):
        with pytest.raises(BadMessage, match='believed from message 3'):
            frame.check_ownship('map', time)
    assert frame.check_ownship('map', 0.2)  # all tracks were taken from the origin
    assert frame.needs_platform
    assert frame.tells_true('frame')


@pytest.mark.parametrize(('sensor', 'doubts'), [
    (SensorConfig(azimuth_convention='compass'), True),
    (SensorConfig(azimuth_convention='clockwise'), False),
    (SensorConfig(azimuth_convention='compass', azimuth_reference='tracking_frame'), False),
    (SensorConfig(azimuth_convention='compass', mount=MountConfig(yaw=-1.57)), False),
])  # fmt: skip
def test_compass_azimuths_in_the_axes_of_a_ship_are_doubted(said, sensor, doubts):
    """Nobody counts from the port beam, which is what they say together."""
    frame = TrackingFrame('', False, said.append)
    frame.check_plots('radar', polar=True)
    check_axes(sensor, frame, pytest.fail)  # it stands still, and y may be north
    frame = TrackingFrame('', False, said.append)
    frame.check_ownship('odom', 0.0)
    frame.check_plots('radar', polar=True)
    check_axes(sensor, frame, lambda _, text: said.append(text))
    assert ("y axis of 'radar'" in said[-1]) == doubts


@pytest.mark.parametrize(('mount', 'assembly', 'words'), [
    (MountConfig(), 'snapshot', []),
    (MountConfig(x=3.0), 'snapshot', ['sensor.mount moves them']),
    (MountConfig(), 'message', ['set scan.assembly to snapshot']),
])  # fmt: skip
def test_places_from_a_ship_that_moves_want_no_mount_and_no_antenna(said, mount, assembly, words):
    """Both are parameters that such a sensor has for other reasons."""
    frame = TrackingFrame('odom', False, said.append)
    frame.check_plots('odom')
    sensor, scan = SensorConfig(mount=mount), ScanConfig(assembly=assembly)
    check_places(sensor, scan, frame, pytest.fail)  # without own ship it stands still
    frame.has_ship = True
    check_places(sensor, scan, frame, lambda _, text: said.append(text))
    assert len(said) == len(words)
    assert all(word in text for word, text in zip(words, said, strict=True))


def test_strange_frame_is_refused_with_both_names_and_ways_out(said):
    """The user reads what to do."""
    frame = TrackingFrame('map', False, said.append)
    with pytest.raises(BadMessage, match=r"'radar', expected 'map'.*ownship.*sensor.mount"):
        frame.check_plots('radar')


def test_plots_may_not_change_their_frame(said):
    """One node, one sensor."""
    frame = TrackingFrame('', False, said.append)
    frame.check_plots('radar')
    with pytest.raises(BadMessage, match="'other', expected 'radar'"):
        frame.check_plots('other')


def test_own_ship_names_the_tracking_frame(said):
    """A sensor on a platform is tracked in the frame of the odometry."""
    frame = TrackingFrame('', False, said.append)
    assert not frame.check_ownship('odom', 0.0)
    frame.check_plots('radar')
    assert frame.name == 'odom'
    assert frame.needs_platform
    with pytest.raises(BadMessage, match="'map', the tracking frame is 'odom'"):
        frame.check_ownship('map', 0.0)


def test_own_ship_that_comes_late_starts_anew_in_its_frame(said):
    """What was taken to stand still moves after all: said, and begun anew once."""
    frame = TrackingFrame('', False, said.append)
    frame.check_plots('radar')
    for time in (0.0, 0.1):
        with pytest.raises(BadMessage, match='believed from message 3'):
            frame.check_ownship('odom', time)
    assert frame.check_ownship('odom', 0.2)
    assert not frame.check_ownship('odom', 0.3)
    frame.check_plots('radar')
    assert frame.name == 'odom'
    assert frame.needs_platform
    assert len(said) == 2


def test_own_ship_that_the_plots_do_not_need_ends_no_track(said):
    """Places in the tracking frame stay where they are; directions were from elsewhere."""
    for polar in (False, True):
        frame = TrackingFrame('', False, said.append)
        frame.check_plots('map', polar)
        for time in (0.0, 0.1):
            with pytest.raises(BadMessage, match='is new'):
                frame.check_ownship('map', time)
        assert frame.check_ownship('map', 0.2) is polar


@pytest.mark.parametrize('messages', [
    [('odom', 1.0)] * 9,
    [('odom', 1.0), ('map', 2.0)] * 5,
    [('odom', 5.0), ('odom', 4.0), ('odom', 3.0), ('odom', 90.0), ('odom', 9.0)],
])  # fmt: skip
def test_own_ship_that_contradicts_itself_is_not_believed(said, messages):
    """Stray messages of one time, of several frames or of any times leave a sensor as it is."""
    frame = TrackingFrame('', False, said.append)
    frame.check_plots('radar')
    for name, time in messages:
        with pytest.raises(BadMessage, match='is new'):
            frame.check_ownship(name, time)
    assert frame.name == 'radar'
    assert not frame.moving


def test_mount_brings_a_stationary_sensor_into_the_tracking_frame(said):
    """The mount is given in a named frame, or refused."""
    frame = TrackingFrame('map', True, said.append)
    frame.check_plots('radar')
    assert not frame.needs_platform
    with pytest.raises(BadMessage, match='set tracking_frame'):
        TrackingFrame('', True, said.append).check_plots('radar')


def test_points_must_be_in_the_tracking_frame(said):
    """A click in another frame would start a track somewhere else."""
    frame = TrackingFrame('map', False, said.append)
    frame.check_point('map')
    with pytest.raises(BadMessage, match="'radar', the tracking frame is 'map'"):
        frame.check_point('radar')
