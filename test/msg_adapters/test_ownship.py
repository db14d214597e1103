# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship's odometry is read as REP 103 and 105 say, or refused."""

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.ownship import to_platform


def odometry(types, yaw=0.0, forward=5.0, scale=1.0, x=10.0, covariance=None):
    """Return an Odometry message."""
    c = np.diag([1.0, 2.0, 3.0, 0.1, 0.2, 0.3]).ravel() if covariance is None else covariance
    pose = types.Pose(
        position=types.Point(x=x, y=20.0, z=0.0),
        orientation=types.Quaternion(
            x=0.0, y=0.0, z=scale * np.sin(0.5 * yaw), w=scale * np.cos(0.5 * yaw)
        ),
    )
    zero = types.Vector3(x=0.0, y=0.0, z=0.0)
    twist = types.Twist(linear=types.Vector3(x=forward, y=0.0, z=0.0), angular=zero)
    return types.Odometry(
        header=types.header(7.5, 'map'),
        child_frame_id='base_link',
        pose=types.PoseWithCovariance(pose=pose, covariance=c),
        twist=types.TwistWithCovariance(twist=twist, covariance=c),
    )


def test_twist_is_turned_from_the_child_frame(types):
    """Forward of a ship that heads north is north."""
    sample = to_platform(odometry(types, yaw=np.pi / 2.0))
    np.testing.assert_allclose(sample.velocity, [[0.0, 5.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(sample.position, [[10.0, 20.0, 0.0]])
    np.testing.assert_allclose(sample.position_covariance[0], np.diag([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(sample.yaw_variance, [0.3])
    np.testing.assert_allclose(sample.time, [7.5])


@pytest.mark.parametrize(
    ('changes', 'match'),
    [
        ({'scale': 0.0}, 'pose.pose.orientation has length 0, not 1'),
        ({'x': np.nan}, 'pose.pose.position is nan'),
        ({'x': 1e300}, 'pose.pose.position is 1e'),
        ({'forward': np.inf}, 'twist.twist.linear is inf'),
    ],
)
def test_pose_that_is_none_is_refused(types, changes, match):
    """The field and its value are named."""
    with pytest.raises(BadMessage, match=match):
        to_platform(odometry(types, **changes))


@pytest.mark.parametrize('value', [np.nan, -1.0, np.inf])
def test_covariance_that_is_none_counts_as_zero_and_is_told(types, value):
    """Drivers that do not know fill in anything."""
    told = {}
    sample = to_platform(odometry(types, covariance=np.full(36, value)), told.__setitem__)
    assert not sample.position_covariance.any()
    assert not sample.yaw_variance.any()
    assert f'variances of x y z = {value:g}, ' in told['covariance of the place']
    assert f'[35] = {value:g} rad^2 is that of no heading' in told['variance of the heading']


@pytest.mark.parametrize('variance', [4.0, 1e5])
def test_heading_that_may_be_any_leaves_the_place_unsure(types, variance):
    """As receivers tell that know no heading; what is nothing to us may be anything."""
    covariance = np.diag([1.0, 2.0, 3.0, np.nan, -1.0, variance])
    told = {}
    sample = to_platform(odometry(types, covariance=covariance.ravel()), told.__setitem__)
    np.testing.assert_array_equal(sample.position_covariance[0], np.diag([1.0, 2.0, 3.0]))
    assert not sample.yaw_variance.any()
    assert list(told) == ['variance of the heading']


@pytest.mark.parametrize(('axis', 'is_told'), [(0, True), (1, True), (2, False)])
def test_place_that_may_be_any_is_that_of_none(types, axis, is_told):
    """Two kilometres over the ground; of heights it is usual where there is none."""
    told, covariance = {}, np.diag([1.0, 2.0, 3.0, 0.1, 0.1, 0.1])
    covariance[axis, axis] = 4e6
    sample = to_platform(odometry(types, covariance=covariance.ravel()), told.__setitem__)
    assert list(told) == ['covariance of the place'] * is_told
    assert sample.position_covariance.any() != is_told


def test_covariance_of_a_line_is_one(types):
    """Own ship may know one direction only; rounding makes one of its variances negative."""
    place = np.zeros((6, 6))
    place[:3, :3] = np.outer([3.0, 4.0, 0.1], [3.0, 4.0, 0.1])
    place[:2, :2] -= 1e-10
    sample = to_platform(odometry(types, covariance=place.ravel()))
    np.testing.assert_array_equal(sample.position_covariance[0], place[:3, :3])
