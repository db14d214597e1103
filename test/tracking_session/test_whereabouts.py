# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Own ship's path is remembered for a time, whatever the rate of the odometry."""

import numpy as np
import pytest

from msg_adapters.row_checks import MAX_OFFSET
from radar_tracker.node_config import radar_node_config
from tracking_core.platform import Platform
from tracking_session.whereabouts import Whereabouts

SPEED = 10.0  # m/s


def sailed(rate, duration):
    """Return the path of a ship that told where it was at a rate [Hz] for so long [s]."""
    whereabouts = Whereabouts(radar_node_config())
    for time in np.arange(0.0, duration, 1.0 / rate):
        sample = Platform(
            time=np.array([time]), position=np.array([[SPEED * time, 0.0, 0.0]]),
            orientation=np.array([[0.0, 0.0, 0.0, 1.0]]), velocity=np.array([[SPEED, 0.0, 0.0]]),
            position_covariance=np.zeros((1, 3, 3)), yaw_variance=np.zeros(1),
        )  # fmt: skip
        whereabouts.take(sample, time)
    return whereabouts.platform


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
