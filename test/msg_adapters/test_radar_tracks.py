# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts as radar_msgs/RadarTracks, with classes built from definitions of the same fields."""

from dataclasses import replace

import numpy as np
import pytest

from msg_adapters.message_types import MessageTypes, rosbags_types
from msg_adapters.radar_tracks import (
    classify,
    DYNAMIC,
    radar_classes,
    RadarClasses,
    STATIC,
    to_radar_tracks,
    UNKNOWN,
)
from msg_adapters.tracks import to_bodies

rosbags = pytest.importorskip('rosbags.typesys')
TRACK = """
uint16 NO_CLASSIFICATION=0
uint16 STATIC=1
uint16 DYNAMIC=2
unique_identifier_msgs/UUID uuid
geometry_msgs/Point position
geometry_msgs/Vector3 velocity
geometry_msgs/Vector3 acceleration
geometry_msgs/Vector3 size
uint16 classification
float32[6] position_covariance
float32[6] velocity_covariance
float32[6] acceleration_covariance
float32[6] size_covariance
"""
TRACKS = 'std_msgs/Header header\nradar_msgs/RadarTrack[] tracks\n'
RUN = bytes(range(8))


@pytest.fixture(scope='module')
def store():
    """Return message classes of Jazzy and of radar_msgs."""
    store = rosbags.get_typestore(rosbags.Stores.ROS2_JAZZY)
    for name, text in (('RadarTrack', TRACK), ('RadarTracks', TRACKS)):
        store.register(rosbags.get_types_from_msg(text, f'radar_msgs/msg/{name}'))
    return store


@pytest.fixture
def send(store):
    """Return a function that turns contacts into a message and back from its bytes."""
    types: MessageTypes = rosbags_types()
    names = ('radar_msgs/msg/RadarTracks', 'radar_msgs/msg/RadarTrack',
             'unique_identifier_msgs/msg/UUID')  # fmt: skip
    classes = RadarClasses(*(store.types[name] for name in names))

    def there_and_back(bodies):
        msg = to_radar_tracks(bodies, RUN, types.header(100.0, 'map'), types, classes)
        return store.deserialize_cdr(store.serialize_cdr(msg, names[0]), names[0])

    return there_and_back


def test_tracks_arrive_with_state_covariance_and_name(send, make_tracks):
    """Upper triangles in the order of the axes; a name of this run and the id."""
    tracks = replace(make_tracks([3, 70_000]), time=np.full(2, 100.0))
    bodies = to_bodies(tracks, 'mmse')
    first, second = send(bodies).tracks
    assert bytes(first.uuid.uuid) == RUN + (3).to_bytes(8, 'big')
    assert bytes(second.uuid.uuid) == RUN + (70_000).to_bytes(8, 'big')
    assert [first.position.x, first.position.z] == bodies.state[0, [0, 2]].tolist()
    assert [second.velocity.y, second.velocity.z] == bodies.state[1, [4, 5]].tolist()
    rows, columns = np.triu_indices(3)
    cov = bodies.covariance[0]
    np.testing.assert_allclose(first.position_covariance, cov[rows, columns], rtol=1e-6)
    np.testing.assert_allclose(first.velocity_covariance, cov[3 + rows, 3 + columns], rtol=1e-6)


def test_tracks_of_many_times_are_told_as_of_the_one_stamp(send, make_tracks):
    """A rotating antenna saw one four seconds ago, one just now; heights may be unknown."""
    tracks = make_tracks([1, 2], dimensions=2)
    bodies = to_bodies(replace(tracks, time=np.array([96.0, 100.0])), 'mmse')
    moved, still = send(bodies).tracks
    x, y, _, vx, vy, _ = bodies.state[0]
    np.testing.assert_allclose([moved.position.x, moved.position.y], [x + 4 * vx, y + 4 * vy])
    assert [still.position.x, still.position.y] == bodies.state[1, :2].tolist()
    F = np.eye(6) + np.diag([4.0] * 3, 3)
    known = np.ix_([0, 1, 3, 4], [0, 1, 3, 4])
    expected = F[known] @ bodies.covariance[0][known] @ F[known].T
    xx, xy, _, yy, _, zz = moved.position_covariance
    np.testing.assert_allclose([xx, xy, yy], expected[[0, 0, 1], [0, 1, 1]], rtol=1e-6)
    assert np.isnan(zz)
    np.testing.assert_allclose(moved.velocity_covariance[0], expected[2, 2], rtol=1e-6)


def test_what_is_not_known_is_nan(send, make_tracks):
    """Acceleration and size always; height variances of a 2-D radar."""
    (track,) = send(to_bodies(make_tracks([1], dimensions=2), 'mmse')).tracks
    assert np.isnan([track.size.x, track.acceleration.y, *track.size_covariance]).all()
    assert np.isnan(track.position_covariance[5])
    assert np.isfinite(track.position_covariance[[0, 1, 3]]).all()


def test_no_tracks_are_a_message(send, make_tracks):
    """An empty picture is a picture."""
    msg = send(to_bodies(make_tracks([]), 'mmse'))
    assert (len(msg.tracks), msg.header.frame_id, msg.header.stamp.sec) == (0, 'map', 100)


def test_contact_is_static_only_where_that_is_known():
    """Moving: beyond the 99 % ellipse; at rest: inside a small one; else nobody knows."""
    velocity = np.array([[5.0, 0.0], [0.5, 0.5], [0.5, 0.5], [np.nan, 0.0]])
    sd = np.array([1.0, 0.5, 5.0, 1.0])
    covariance = sd[:, None, None] ** 2 * np.eye(2)
    covariance[3] *= np.nan
    np.testing.assert_array_equal(
        classify(velocity, covariance), [DYNAMIC, STATIC, UNKNOWN, UNKNOWN]
    )


def test_package_that_is_not_installed_is_named():
    """The error says what to install."""
    with pytest.raises(ValueError, match=r'needs the package radar_msgs.*radar-msgs'):
        radar_classes()
