# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship's place: what leads on is believed, one leap is not, several that agree are."""

from dataclasses import replace

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from tracking_core.platform import Platform
from tracking_session.leap_guard import LeapGuard

STEP = 0.5  # s


def sample(time, x, speed=0.0, sd=0.0):
    """Return one odometry; without a speed it has no twist."""
    return Platform(
        time=np.array([time]), position=np.array([[x, 0.0, 0.0]]),
        orientation=np.array([[0.0, 0.0, 0.0, 1.0]]), velocity=np.array([[speed, 0.0, 0.0]]),
        position_covariance=sd**2 * np.eye(3)[None], yaw_variance=np.zeros(1),
    )  # fmt: skip


def sail(guard, steps, speed=10.0, start=0, leap=0.0, twist=True):
    """Accept samples of an even course from a step on; return whether any was a leap."""
    leaps = [
        guard.accept(sample(STEP * k, speed * STEP * k + leap, speed if twist else 0.0))
        for k in range(start, start + steps)
    ]
    return any(leaps)


def test_accept_believes_an_even_course_with_or_without_twist():
    """An aircraft at 300 m/s moves more than the limit from sample to sample."""
    for twist in (True, False):
        assert not sail(LeapGuard(100.0, 2.0), 20, speed=300.0, twist=twist)


def test_accept_refuses_one_leap_and_goes_on():
    """The message says how far; the samples after it are believed at once."""
    guard = LeapGuard(100.0, 2.0)
    sail(guard, 4)
    with pytest.raises(BadMessage, match='is 1000 m from where the last ones led; limit 100 m'):
        sail(guard, 1, start=4, leap=1000.0)
    assert not sail(guard, 4, start=5)


def test_accept_believes_a_leap_that_stays():
    """The third place that agrees is a leap, the fourth is ordinary."""
    guard = LeapGuard(100.0, 2.0)
    sail(guard, 4)
    for k in (4, 5):
        with pytest.raises(BadMessage):
            sail(guard, 1, start=k, leap=1000.0)
    assert sail(guard, 1, start=6, leap=1000.0)
    assert not sail(guard, 4, start=7, leap=1000.0)


def test_accept_lets_a_place_be_as_far_off_as_its_covariance_says():
    """A ship that says that it is lost by 100 m is no leap at 300 m, and is one at 1500 m."""
    guard = LeapGuard(100.0, 2.0)
    rng = np.random.default_rng(1)
    for k in range(100):
        assert not guard.accept(sample(STEP * k, rng.normal(0.0, 100.0), sd=100.0))
    with pytest.raises(BadMessage, match='limit 666 m'):
        guard.accept(sample(STEP * 100, 1500.0, sd=100.0))


def test_accept_believes_a_new_pace_that_the_twist_explains():
    """From rest to 600 m/s in a second, half of it on the way; without twist it is a leap."""
    for twist in (600.0, 0.0):
        guard = LeapGuard(100.0, 2.0)
        for time in (0.0, 1.0, 2.0):
            guard.accept(sample(time, 0.0))
        if twist:
            assert not guard.accept(sample(3.0, 300.0, twist))
        else:
            with pytest.raises(BadMessage, match='is 300 m from'):
                guard.accept(sample(3.0, 300.0))


def test_accept_never_believes_places_that_do_not_agree():
    """A receiver that has gone wild moves nobody."""
    guard = LeapGuard(100.0, 20.0)
    sail(guard, 4)
    for k in range(4, 20):
        with pytest.raises(BadMessage):
            sail(guard, 1, start=k, leap=1000.0 * (1 + k * k))


def test_accept_believes_any_place_that_own_ship_can_have_gone_to_in_a_silence():
    """It may have turned about, or set sail; half an hour is enough for every place."""
    for speed, silence, gone in ((10.0, 5.0, -50.0), (0.0, 20.0, 250.0), (0.0, 1800.0, 1e6)):
        guard = LeapGuard(100.0, 2.0)
        sail(guard, 4, speed)
        assert not guard.accept(sample(1.5 + silence, 1.5 * speed + gone, speed))


def test_accept_tells_a_leap_in_a_silence():
    """Five seconds at 10 m/s are no kilometre: the third place there is believed, as a leap."""
    guard = LeapGuard(100.0, 2.0)
    sail(guard, 4)
    for k in (13, 14):
        with pytest.raises(BadMessage, match=r'is 1000 m .*; limit [23]\d\d m'):
            sail(guard, 1, start=k, leap=1000.0)
    assert sail(guard, 1, start=15, leap=1000.0)


def test_accept_tells_a_leap_of_a_ship_that_does_not_know_its_height():
    """As of receivers, which tell 1e6 m^2 of z where they track in the plane."""
    guard, unsure = LeapGuard(100.0, 2.0), np.diag([4.0, 4.0, 1e6])[None]
    for k in range(4):
        guard.accept(replace(sample(STEP * k, 5.0 * k, 10.0), position_covariance=unsure))
    with pytest.raises(BadMessage, match='limit 111 m'):
        guard.accept(replace(sample(2.0, 1020.0, 10.0), position_covariance=unsure))


def test_accept_knows_nothing_without_a_limit():
    """Then any place is believed."""
    free = LeapGuard(0.0, 2.0)
    sail(free, 4)
    assert not sail(free, 1, start=4, leap=1000.0)
