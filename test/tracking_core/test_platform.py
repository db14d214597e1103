# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The platform is where its samples say, between and shortly beyond them."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from tracking_core.platform import Platform, StalePlatform
from tracking_core.platform_pose import PlatformPose


def sample(time, x=0.0, yaw=0.0, speed=10.0):
    """Return one sample of a platform."""
    return Platform(
        time=np.array([time]),
        position=np.array([[x, 0.0, 0.0]]),
        orientation=Rotation.from_euler('z', yaw).as_quat().reshape(1, 4),
        velocity=np.array([[speed, 0.0, 0.0]]),
        position_covariance=np.eye(3)[None],
        yaw_variance=np.array([0.01]),
    )


def of(*samples, **options):
    """Return a platform with these samples."""
    platform = Platform.empty(**options)
    for one in samples:
        platform = platform.add(one)
    return platform


def test_position_is_linear_and_orientation_turns_evenly_between_samples():
    """Oracle: numpy's interpolation and scipy's Slerp."""
    rng = np.random.default_rng(1)
    time = np.sort(rng.uniform(0.0, 10.0, 6))
    turns = Rotation.random(6, random_state=2)
    platform = Platform(
        time, rng.normal(size=(6, 3)), turns.as_quat(), rng.normal(size=(6, 3)),
        np.tile(np.eye(3), (6, 1, 1)), np.ones(6),
    )  # fmt: skip
    times = rng.uniform(time[0], time[-1], 20)
    pose = platform.at(times)
    expected = [np.interp(times, time, platform.position[:, axis]) for axis in range(3)]
    np.testing.assert_allclose(pose.position.T, expected)
    off = Rotation.from_quat(pose.orientation).inv() * Slerp(time, turns)(times)
    np.testing.assert_allclose(off.magnitude(), 0.0, atol=1e-9)


def test_rotation_turns_platform_axes_to_tracking_axes():
    """Oracle: scipy's Rotation; heading alone is a turn about the vertical."""
    turns = Rotation.random(10, random_state=3)
    nothing = np.zeros((10, 3))
    pose = PlatformPose(
        nothing, turns.as_quat(), nothing, np.zeros((10, 3, 3)), np.zeros(10), nothing
    )
    np.testing.assert_allclose(pose.rotation, turns.as_matrix(), atol=1e-12)


def test_platform_goes_on_beyond_its_samples_for_a_while():
    """Position by its velocity, heading by its last turn."""
    platform = of(sample(0.0), sample(1.0, x=10.0, yaw=0.1))
    pose = platform.at(np.array([2.0, -1.0]))
    np.testing.assert_allclose(pose.position[:, 0], [20.0, -10.0])
    np.testing.assert_allclose(pose.yaw, [0.2, -0.1], atol=1e-9)


def test_one_sample_is_enough():
    """It goes straight on."""
    pose = of(sample(5.0, x=3.0, yaw=1.0)).at(np.array([5.0, 6.0]))
    np.testing.assert_allclose(pose.position[:, 0], [3.0, 13.0])
    np.testing.assert_allclose(pose.yaw, 1.0)


@pytest.mark.parametrize('time', [-2.5, 3.5])
def test_stale_samples_are_refused_with_age_and_limit(time):
    """Too far before or after is an error, not a guess."""
    platform = of(sample(0.0), sample(1.0), max_extrapolation=2.0)
    with pytest.raises(StalePlatform, match=r'2\.5 s away.*limit 2 s'):
        platform.at(np.array([0.5, time]))


def test_unknown_platform_is_refused():
    """No sample, no place; but nothing asked is nothing refused."""
    with pytest.raises(StalePlatform, match='no sample'):
        Platform.empty().at(np.array([1.0]))
    assert len(Platform.empty().at(np.zeros(0)).position) == 0
    assert len(Platform.empty().add()) == 0


def test_samples_are_kept_in_order_and_bounded():
    """A late sample falls into its place, a newer message of one time wins, old ones go."""
    platform = of(
        sample(2.0), sample(1.0), sample(3.0), sample(2.0, x=7.0), sample(4.0), capacity=3
    )
    np.testing.assert_array_equal(platform.time, [2.0, 3.0, 4.0])
    assert platform.position[0, 0] == 7.0


def test_samples_of_the_span_are_kept_beyond_the_capacity():
    """Those of the last seconds, however many; older ones as far as there is room."""
    platform = Platform.empty(capacity=3)
    for time in (1.0, 7.0, 8.0, 9.0, 10.0):
        platform = platform.add(sample(time), span=3.0)
    np.testing.assert_array_equal(platform.time, [7.0, 8.0, 9.0, 10.0])
    np.testing.assert_array_equal(platform.add(sample(20.0), span=3.0).time, [9.0, 10.0, 20.0])


def test_many_samples_at_once_are_as_one_by_one():
    """Late ones and two at one time included: the one that came later wins."""
    times = (3.0, 1.0, 2.0, 2.0, 4.0, 1.0)
    samples = [sample(time, float(number)) for number, time in enumerate(times)]
    one_by_one = Platform.empty(capacity=3)
    for each in samples:
        one_by_one = one_by_one.add(each)
    at_once = Platform.empty(capacity=3).add(*samples)
    np.testing.assert_array_equal(at_once.time, [2.0, 3.0, 4.0])
    np.testing.assert_array_equal(at_once.position, one_by_one.position)


@pytest.mark.parametrize('rate', [10.0, 200.0])
def test_heading_beyond_the_samples_does_not_swing_with_their_noise(rate):
    """0.5 mrad of noise become no more than four times as many 1.5 s later, at any rate."""
    rng, errors = np.random.default_rng(1), []
    for _ in range(200):
        times = np.arange(0.0, 2.0, 1.0 / rate)
        platform = of(*(sample(t, yaw=0.1 * t + rng.normal(0.0, 5e-4)) for t in times[-150:]))
        errors.append(platform.at(times[-1:] + 1.5).yaw[0] - 0.1 * (times[-1] + 1.5))
    assert np.std(errors) < 4.5 * 5e-4 * np.sqrt(2.0)


def test_turn_rate_is_that_of_the_platform():
    """About its own axes, between the samples and beyond."""
    platform = of(*(sample(t, yaw=0.3 * t) for t in np.arange(0.0, 3.0, 0.1)))
    pose = platform.at(np.array([-0.5, 0.0, 1.23, 2.9, 4.0]))
    np.testing.assert_allclose(pose.turn_rate, np.tile([0.0, 0.0, 0.3], (5, 1)), atol=1e-9)
    np.testing.assert_allclose(pose.yaw, 0.3 * np.array([-0.5, 0.0, 1.23, 2.9, 4.0]), atol=1e-9)
