# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Sonar tracks become rows with documented columns, bodies where they are located, and fans."""

from dataclasses import dataclass

import numpy as np
import pytest

from msg_adapters.bearing_tracks import from_bearing_tracks, located_bodies
from msg_adapters.fans import Fans, LOCATED, NAMESPACES, to_fan_markers
from msg_adapters.table import to_columns
from tracking_core.batches import Mixture, Tracks


@dataclass(frozen=True)
class States:
    """Directions, as a sonar tracker tells them."""

    bearing: np.ndarray
    bearing_rate: np.ndarray
    bearing_sd: np.ndarray
    bearing_rate_sd: np.ndarray


@dataclass(frozen=True)
class Ranges:
    """Ranges, as a sonar tracker tells them."""

    observable: np.ndarray
    range: np.ndarray
    range_sd: np.ndarray
    speed: np.ndarray
    course: np.ndarray
    state: np.ndarray
    covariance: np.ndarray


def tracks_of(*ids):
    """Return tracks with bearings of 0.5 rad times their ids."""
    T = len(ids)
    mean = np.stack([0.5 * np.array(ids, float), np.full(T, 1e-3)], axis=1).reshape(T, 1, 2)
    covariance = np.tile(np.diag([1e-4, 1e-8]), (T, 1, 1, 1))
    plane = Mixture(mean, covariance, np.ones((T, 1)), np.zeros((T, 0)))
    return Tracks(
        id=np.array(ids, np.int64), time=np.full(T, 99.5), birth_time=np.full(T, 90.0),
        planes=(plane,), existence_probability=np.ones(T), confirmed=np.ones(T, bool),
        hits=np.full(T, 5), misses=np.zeros(T, np.int64), outside=np.zeros(T, np.int64),
        history=np.ones(T, np.int64), gate_size=np.full((T, 1), 0.05), gate_volume=np.full(T, 0.1),
        nis=np.full(T, np.nan), doubled=np.zeros(T, np.int64), level=np.full(T, np.nan),
    )  # fmt: skip


def directions(tracks, output):
    """Return the directions of tracks."""
    mean, covariance = tracks.planes[0].estimate(output)
    return States(*mean.T, *np.sqrt(np.einsum('tnn->tn', covariance)).T)


def ranges_of(tracks, *observable):
    """Return ranges of 1 km times the id where they are observable."""
    known = np.array(observable, bool)
    far = np.where(known, 1e3 * tracks.id, np.nan)
    state = np.where(
        known[:, None], np.stack([far, 2 * far, far / 1e3, far / 5e2], axis=1), np.nan
    )
    covariance = np.where(known[:, None, None], np.diag([1.0, 2.0, 3.0, 4.0]), np.nan)
    return Ranges(known, far, far / 10, far / 1e3, far * 0.0 + 1.0, state, covariance)


def rows_of(types, previous, tracks, ranges):
    """Return the table of tracks, there and back."""
    msg = from_bearing_tracks(
        previous, tracks, ranges, types.header(100.0, 'map'), types, directions=directions,
        output='mmse', gate_probability=0.99,
    )  # fmt: skip
    return to_columns(msg, 100)


def test_columns_are_those_of_the_documentation(types):
    """Names and datatypes are a promise."""
    tracks = tracks_of(1, 2)
    columns = rows_of(types, tracks, tracks, ranges_of(tracks, False, True))
    kinds = {name: values.dtype.str[1:] for name, values in columns.items()}
    whole = {
        'id': 'u4', 'hits': 'u4', 'misses': 'u4', 'status': 'u1', 'coasted': 'u1',
        'observable': 'u1',
    }  # fmt: skip
    singles = (
        'x y z time age existence_probability manoeuvre_probability p_0 nis gate_threshold '
        'gate_volume bearing bearing_rate bearing_sd bearing_rate_sd gate range range_sd speed '
        'course'
    )
    assert kinds == {**whole, **dict.fromkeys(singles.split(), 'f4'), 'covariance': 'f8'}
    assert columns['covariance'].shape == (2, 16)


def test_range_is_told_where_it_is_observable_and_nowhere_else(types):
    """Else x, y, z is the unit vector on the bearing; a deleted track has no range."""
    tracks = tracks_of(1, 2)
    columns = rows_of(types, tracks_of(1, 2, 3), tracks, ranges_of(tracks, False, True))
    np.testing.assert_array_equal(columns['id'], [1, 2, 3])
    np.testing.assert_array_equal(columns['status'], [1, 1, 2])
    np.testing.assert_array_equal(columns['observable'], [0, 1, 0])
    np.testing.assert_allclose(columns['x'], [np.cos(0.5), 2e3, np.cos(1.5)], rtol=1e-6)
    np.testing.assert_allclose(columns['y'], [np.sin(0.5), 4e3, np.sin(1.5)], rtol=1e-6)
    for name, value in (('range', 2e3), ('range_sd', 200.0), ('speed', 2.0), ('course', 1.0)):
        np.testing.assert_allclose(columns[name], [np.nan, value, np.nan], rtol=1e-6)
    assert np.isnan(columns['covariance'][[0, 2]]).all()
    np.testing.assert_array_equal(columns['covariance'][1, ::5], [1.0, 2.0, 3.0, 4.0])
    np.testing.assert_allclose(columns['bearing_sd'], 0.01, rtol=1e-6)
    np.testing.assert_allclose(columns['gate'], 0.05, rtol=1e-6)


def test_bodies_are_those_that_are_located():
    """Position and velocity stand where everybody expects them; height is not known."""
    tracks = tracks_of(1, 2, 3)
    bodies = located_bodies(tracks, ranges_of(tracks, False, True, True), tracks.id != 3)
    assert bodies.id.tolist() == [2]
    np.testing.assert_allclose(bodies.state, [[2e3, 4e3, 0.0, 2.0, 4.0, 0.0]])
    np.testing.assert_array_equal(np.diag(bodies.covariance[0])[[0, 1, 3, 4]], [1, 2, 3, 4])
    P, off = bodies.covariance[0], ~np.eye(6, dtype=bool)
    assert np.isnan(np.diag(P)[[2, 5]]).all()
    np.testing.assert_array_equal(P[2, off[2]], 0.0)  # what is not known hangs on to nothing
    np.testing.assert_array_equal(P[5, off[5]], 0.0)


def drawn(types, tracks, observable, shown=(), axis=None):
    """Return the markers by namespace and id."""
    located = located_bodies(tracks, ranges_of(tracks, *observable), np.ones(len(tracks), bool))
    states = directions(tracks, 'mmse')
    fans = Fans(
        states.bearing, states.bearing_sd, tracks.gate_size[:, 0], (7.0, 8.0, 0.0), axis, 1e4
    )
    msg = to_fan_markers(
        tracks, fans, located, set(shown), types.header(1.0, 'map'), types, lead_time=60.0
    )
    return {(marker.ns, marker.id): marker for marker in msg.markers}


def test_fan_begins_at_the_sensor_and_is_as_wide_as_the_bearing_is_unsure(types):
    """One triangle, turned to the bearing, three sd to each side."""
    fan = drawn(types, tracks_of(1), [False])['fan', 1]
    assert (fan.pose.position.x, fan.pose.position.y) == (7.0, 8.0)
    assert 2.0 * np.arctan2(fan.pose.orientation.z, fan.pose.orientation.w) == pytest.approx(0.5)
    assert fan.scale.x == pytest.approx(1e4)
    assert fan.scale.y == pytest.approx(1e4 * np.tan(0.03))
    corners = np.array([[p.x, p.y] for p in fan.points]).reshape(-1, 3, 2)
    assert not corners[:, 0].any()
    ends = corners[:, 1:].reshape(-1, 2) * [fan.scale.x, fan.scale.y]
    np.testing.assert_allclose(np.hypot(*ends.T), 1e4)  # an arc
    angle = np.arctan2(ends[:, 1], ends[:, 0])
    assert [angle.min(), angle.max()] == pytest.approx([-0.03, 0.03])
    assert np.all(angle[2::2] == angle[1:-1:2])  # without gaps


def test_fan_fades_outwards(types):
    """How far the contact is, nobody knows; viewers multiply the two opacities."""
    fan = drawn(types, tracks_of(1), [False])['fan', 1]
    assert fan.color.a == 1.0
    assert len(fan.colors) == len(fan.points)
    assert fan.colors[0].a > fan.colors[1].a == fan.colors[2].a > 0.0


def test_second_fan_is_the_mirror_image_in_the_axis_and_fainter(types):
    """Only an array that cannot tell the side has one."""
    assert ('mirror', 1) not in drawn(types, tracks_of(1), [False])
    markers = drawn(types, tracks_of(1), [False], axis=np.pi / 2)
    mirror = markers['mirror', 1]
    turn = 2.0 * np.arctan2(mirror.pose.orientation.z, mirror.pose.orientation.w)
    assert turn == pytest.approx(np.pi - 0.5)
    assert mirror.colors[0].a < markers['fan', 1].colors[0].a


def test_position_is_drawn_where_it_is_known_and_taken_away_with_it(types):
    """Ellipse and arrow come and go with the range; of a track that is gone all goes."""
    delete = types.Marker.DELETE
    markers = drawn(types, tracks_of(1, 2), [False, True], shown=(1, 3))
    assert all(markers[space, 2].action != delete for space in LOCATED)
    assert all(markers[space, 1].action == delete for space in LOCATED)
    assert all(markers[space, 3].action == delete for space in NAMESPACES)
    assert markers['fan', 1].action != delete


def test_no_tracks_draw_nothing(types):
    """And do not fail."""
    assert drawn(types, tracks_of(), []) == {}
