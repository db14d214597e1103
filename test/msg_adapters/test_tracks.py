# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Tracks become rows with documented columns, and odometry."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from msg_adapters import message_types
from msg_adapters.markers import to_markers
from msg_adapters.odometry import to_odometry
from msg_adapters.tracks import from_tracks, kinematics, to_bodies, to_track_columns
from msg_adapters.trails import Trails
from tracking_core.chances import chi_square_bound
from tracking_core.rows import take

OPTIONS = {'output': 'mmse', 'gate_probability': 0.99}


def rows_of(previous, tracks, types):
    """Return the track table of these tracks, there and back."""
    header = types.header(100.0, 'map')
    return to_track_columns(from_tracks(previous, tracks, header, types, **OPTIONS))


def test_columns_are_those_of_the_documentation(types, make_tracks):
    """Names and datatypes are a promise."""
    tracks = make_tracks([3, 7])
    columns = rows_of(tracks, tracks, types)
    kinds = {name: values.dtype.str[1:] for name, values in columns.items()}
    whole = {'id': 'u4', 'hits': 'u4', 'misses': 'u4', 'status': 'u1', 'coasted': 'u1'}
    singles = (
        'x y z vx vy vz speed course time age existence_probability manoeuvre_probability '
        'manoeuvre_probability_vertical p_0 p_1 p_vertical_0 p_vertical_1 nis gate_threshold '
        'gate_volume gate_x gate_y gate_z'
    )
    assert kinds == {**whole, **dict.fromkeys(singles.split(), 'f4'), 'covariance': 'f8'}


def test_rows_say_what_the_tracks_say(types, make_tracks):
    """Identity, times and probabilities arrive unchanged."""
    tracks = make_tracks([3, 7])
    columns = rows_of(tracks, tracks, types)
    np.testing.assert_array_equal(columns['id'], [3, 7])
    np.testing.assert_array_equal(columns['status'], [1, 0])
    np.testing.assert_array_equal(columns['coasted'], [0, 1])
    np.testing.assert_allclose(columns['time'], -0.5)
    np.testing.assert_allclose(columns['age'], 9.5)
    np.testing.assert_allclose(columns['p_0'] + columns['p_1'], 1.0, rtol=1e-6)
    np.testing.assert_allclose(columns['manoeuvre_probability'], columns['p_1'], atol=1e-6)
    np.testing.assert_allclose(columns['speed'], np.hypot(columns['vx'], columns['vy']), rtol=1e-6)
    np.testing.assert_allclose(columns['gate_threshold'], chi2.ppf(0.99, 3), rtol=1e-6)


def test_track_outside_the_coverage_coasts(types, make_tracks):
    """What nobody can see has no plot; its looks are counted with the misses before them."""
    tracks = replace(make_tracks([3, 7]), misses=np.array([0, 1]), outside=np.array([2, 2]))
    columns = rows_of(tracks, tracks, types)
    np.testing.assert_array_equal(columns['coasted'], [1, 1])
    np.testing.assert_array_equal(columns['misses'], [2, 3])


def test_covariance_is_ordered_x_y_z_vx_vy_vz(make_tracks):
    """Each element stands where row-major order of the six says."""
    tracks = make_tracks([1])
    state, covariance = kinematics(tracks, 'map')
    plane = tracks.planes[0]
    best = plane.mode_probability[0].argmax()
    np.testing.assert_array_equal(state[0, [0, 3, 1, 4]], plane.mean[0, best])
    assert covariance[0, 0, 4] == plane.covariance[0, best, 0, 3]  # x and vy
    assert (
        covariance[0, 2, 5]
        == tracks.planes[1].covariance[0, tracks.planes[1].mode_probability[0].argmax(), 0, 1]
    )
    assert np.all(np.linalg.eigvalsh(covariance[0]) > 0.0)


def test_tracks_without_height_say_so(types, make_tracks):
    """2-D: z and vz are 0, their variances NaN."""
    tracks = make_tracks([1], dimensions=2)
    columns = rows_of(tracks, tracks, types)
    assert columns['z'][0] == columns['vz'][0] == 0.0
    assert np.isnan(np.diag(columns['covariance'].reshape(6, 6))[[2, 5]]).all()
    assert np.isnan(columns['gate_z'][0])
    assert 'p_vertical_0' not in columns


def test_track_that_is_gone_is_sent_once_as_deleted(types, make_tracks):
    """Its last row comes with status 2."""
    columns = rows_of(make_tracks([1, 2]), make_tracks([2, 3]), types)
    np.testing.assert_array_equal(columns['id'], [2, 3, 1])
    assert columns['status'][2] == 2
    assert 2 not in columns['status'][:2]


@pytest.mark.parametrize('before', [2, 3])
def test_track_of_other_dimensions_has_its_last_row(types, make_tracks, before):
    """The radar was found to tell heights, or began anew; the columns are those of now."""
    previous, now = make_tracks([1], dimensions=before), make_tracks([3], dimensions=5 - before)
    columns = rows_of(previous, now, types)
    assert list(columns) == list(rows_of(now, now, types))
    np.testing.assert_array_equal(columns['id'], [3, 1])
    np.testing.assert_array_equal(columns['status'], [1, 2])
    last = rows_of(previous, previous, types)
    for name, values in columns.items():
        expected = last[name] if name in last else np.full(1, np.nan)
        if name != 'status':
            np.testing.assert_array_equal(values[1:], expected)


def test_no_tracks_make_an_empty_table(types, make_tracks):
    """The columns are there without rows."""
    columns = rows_of(make_tracks([]), make_tracks([]), types)
    assert columns['covariance'].shape == (0, 36)


@pytest.mark.parametrize('degrees', [1, 2, 3])
def test_chi_square_bound_is_the_quantile(degrees):
    """The closed form agrees with scipy's distribution."""
    np.testing.assert_allclose(chi_square_bound(0.997, degrees), chi2.ppf(0.997, degrees))


def test_odometry_has_its_twist_in_the_child_frame(types, make_tracks):
    """Turned back by the pose, the twist is the track's velocity, covariance included."""
    tracks = make_tracks([4, 5, 6])
    state, covariance = kinematics(tracks, 'mmse')
    confirmed = take(tracks, tracks.confirmed)
    first, second = to_odometry(to_bodies(confirmed, 'mmse'), 'map', types)
    assert (first.child_frame_id, second.child_frame_id) == ('track_4', 'track_6')
    q, v = first.pose.pose.orientation, first.twist.twist.linear
    turn = Rotation.from_quat([q.x, q.y, q.z, q.w])
    np.testing.assert_allclose(turn.apply([v.x, v.y, v.z]), state[0, 3:], atol=1e-9)
    assert v.y == 0.0
    twist = np.asarray(first.twist.covariance).reshape(6, 6)[:3, :3]
    back = turn.as_matrix() @ twist @ turn.as_matrix().T
    np.testing.assert_allclose(back, covariance[0, 3:, 3:], rtol=1e-9, atol=1e-9)


def test_odometry_never_holds_nan(types, make_tracks):
    """What a 2-D radar does not know is a large variance: NaN would break readers."""
    (msg,) = to_odometry(to_bodies(make_tracks([1], dimensions=2), 'mmse'), 'map', types)
    assert np.isfinite(msg.pose.covariance).all()
    assert np.isfinite(msg.twist.covariance).all()


@pytest.mark.parametrize('value', [np.nan, 1e300, -1e300, 0.0])
def test_odd_numbers_can_be_sent(make_tracks, value):
    """Every output is serialised, with field checks on, whatever is in the tracks."""
    serialization = pytest.importorskip('rclpy.serialization')
    types = message_types.rclpy_types()
    tracks = make_tracks([1, 2])
    odd = [replace(plane, mean=np.full_like(plane.mean, value)) for plane in tracks.planes]
    tracks = replace(
        tracks, planes=tuple(odd), gate_size=np.full((2, 3), value), nis=np.full(2, value),
        gate_volume=np.full(2, value), existence_probability=np.full(2, value),
    )  # fmt: skip
    header = types.header(100.0, 'map')
    drawing = {'lean': np.full(2, value), 'output': 'mmse', 'lead_time': 10.0}
    with np.errstate(all='ignore'):
        messages = [
            from_tracks(tracks, tracks, header, types, **OPTIONS),
            *to_odometry(to_bodies(tracks, 'map'), 'map', types),
            to_markers(tracks, Trails.empty(5), {1, 3}, header, types, **drawing),
        ]
    assert all(serialization.serialize_message(message) for message in messages)


def test_trails_follow_their_track_when_rows_move():
    """A trail belongs to the id, newest first; new tracks begin with one point."""
    first = Trails.empty(3).extend(np.array([1, 2]), np.array([[1.0] * 3, [2.0] * 3]))
    second = first.extend(np.array([2, 3]), np.array([[5.0] * 3, [6.0] * 3]))
    np.testing.assert_array_equal(second.position[:, :, 0], [[5, 2, np.nan], [6, np.nan, np.nan]])
