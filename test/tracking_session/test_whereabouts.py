# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship's path is remembered for a time, whatever the rate of the odometry."""

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.row_checks import MAX_OFFSET
from radar_tracker.node_config import radar_node_config
from tracking_core.platform import Platform
from tracking_session.whereabouts import Whereabouts

SPEED = 10.0  # m/s


def sample(time, leap=0.0):
    """Return where a ship is that sails along x, or so far beside that [m]."""
    return Platform(
        time=np.array([time]), position=np.array([[SPEED * time, leap, 0.0]]),
        orientation=np.array([[0.0, 0.0, 0.0, 1.0]]), velocity=np.array([[SPEED, 0.0, 0.0]]),
        position_covariance=np.zeros((1, 3, 3)), yaw_variance=np.zeros(1),
    )  # fmt: skip


def sailing(rate, duration):
    """Return what is known of a ship that told where it was at a rate [Hz] for so long [s]."""
    whereabouts = Whereabouts(radar_node_config())
    for time in np.arange(0.0, duration, 1.0 / rate):
        whereabouts.take(sample(time), time)
    return whereabouts


def sailed(rate, duration):
    """Return the path of that ship."""
    return sailing(rate, duration).platform


@pytest.mark.parametrize('rate', [200.0, 1_000.0])
def test_path_of_fast_odometry_covers_a_slow_turn(rate) -> None:
    """Where the ship was when the antenna began its turn of 12 s; it was 2000 samples."""
    path = sailed(rate, 14.0)
    times = np.linspace(0.0, 13.9, 50)
    np.testing.assert_allclose(path.at(times).position[:, 0], SPEED * times, atol=1e-9)
    assert path.time[0] == 0.0
    assert len(path) <= 14.0 / 0.007 + 1


def test_path_of_fast_odometry_is_bounded() -> None:
    """A minute is kept, not more."""
    path = sailed(125.0, MAX_OFFSET + 10.0)
    assert path.time[-1] - path.time[0] == pytest.approx(MAX_OFFSET, abs=0.01)


@pytest.mark.parametrize('rate', [1.0, 10.0, 125.0])
def test_path_of_slow_odometry_has_every_sample(rate) -> None:
    """Up to 125 Hz nothing is left out."""
    np.testing.assert_array_equal(sailed(rate, 10.0).time, np.arange(0.0, 10.0, 1.0 / rate))


def test_any_place_is_believed_after_a_reset() -> None:
    """As after a start: none of those before it counts."""
    whereabouts = sailing(10.0, 3.0)
    with pytest.raises(BadMessage, match='from where the last ones led'):
        whereabouts.take(sample(3.0, leap=5e3), 3.0)
    whereabouts.reset()
    assert not whereabouts.take(sample(3.1, leap=5e3), 3.1)
    assert whereabouts.platform.time.tolist() == [3.1]


def test_path_begins_anew_at_once_where_the_clock_went_back() -> None:
    """Wherever the ship was at that time; without the clock's word two samples are refused."""
    for leap in (0.0, 5e3):
        whereabouts = sailing(10.0, 30.0)
        with pytest.raises(BadMessage, match='behind the last one'):
            whereabouts.take(sample(1.0, leap), 30.0)
        whereabouts.clock_moved()
        assert not whereabouts.take(sample(1.1, leap), 30.0)
        assert whereabouts.platform.time.tolist() == [1.1]


@pytest.mark.parametrize(
    ('batch', 'pause', 'expected'), [(1, 0.0, 0.7), (10, 0.0, 2.5), (1, 5.0, 0.7)]
)
def test_silence_is_longer_than_odometry_uses_to_pause(batch, pause, expected) -> None:
    """A quarter of the patience and two steps, or two batches; one long pause is none of them."""
    whereabouts = Whereabouts(radar_node_config())
    for number in range(100):
        time = 0.1 * number
        received = 0.1 * batch * (number // batch) + pause * (number > 80)
        whereabouts.take(sample(time), received)
    silent = [t for t in np.arange(0.0, 4.0, 0.01) if whereabouts.is_silent(received + t, 2.0)]
    assert min(silent) == pytest.approx(expected, abs=0.011)
    assert not Whereabouts(radar_node_config()).is_silent(1e9, 2.0)
