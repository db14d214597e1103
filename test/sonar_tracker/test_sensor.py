# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How sure a sonar is of its marks."""

import numpy as np
import pytest

from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.sensor import Sonar
from sonar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Bearings, Coverage
from tracking_core.config import with_values

AXIS = 0.7  # of the array, in the tracking frame [rad]
FROM_AXIS = np.radians([90.0, 30.0, 10.0, -10.0, 1.0])


def marks(bearing_sd):
    """Return a mark at each angle from the axis that tells this sd."""
    nothing = np.full(len(FROM_AXIS), np.nan)
    return Bearings(
        time=np.zeros(len(FROM_AXIS)), bearing=FROM_AXIS, snr=nothing,
        bearing_sd=np.broadcast_to(bearing_sd, len(FROM_AXIS)),
    )  # fmt: skip


@pytest.mark.parametrize(
    ('array', 'factor'),
    [('omnidirectional', np.ones(5)), ('linear', [1.0, 2.0, 5.76, 5.76, 20.0])],
)
def test_beam_of_a_linear_array_widens_off_broadside(array, factor):
    """By 1 / sin of the angle from its axis, in marks and gates alike; 20 times at most."""
    sonar = Sonar(SensorConfig(array=array, bearing_sd=0.01), 0.0)
    expected = 0.01 * np.array(factor)
    np.testing.assert_allclose(sonar.mark_sd(marks(np.nan)), expected, rtol=1e-3)
    looked = Coverage(0.0, 1.0, sector_centre=AXIS + sonar.config.sector_centre)
    noise = sonar.noise((FROM_AXIS + AXIS)[:, None], looked)
    np.testing.assert_allclose(np.sqrt(noise[:, 0, 0]), expected, rtol=1e-3)


def test_what_marks_tell_is_not_widened():
    """The array knows best; gates are as wide as marks usually say."""
    sonar = Sonar(SensorConfig(array='linear', bearing_sd=0.01), 0.003)
    np.testing.assert_allclose(sonar.mark_sd(marks(0.002)), 0.002)
    noise = sonar.noise(FROM_AXIS[:, None], Coverage(0.0, 1.0))
    np.testing.assert_allclose(noise, 0.003**2)


def test_marks_that_tell_nothing_usable_have_the_sd_of_the_parameter():
    """Not a number, infinite, zero and negative are no sd; one too small is not believed."""
    sonar = Sonar(SensorConfig(bearing_sd=0.01, bearing_sd_min=0.002), 0.0)
    told = np.array([np.nan, np.inf, 0.0, -1.0, 0.001])
    found = sonar.mark_sd(marks(told))
    np.testing.assert_allclose(found, [0.01, 0.01, 0.01, 0.01, 0.002])


def test_marks_count_on_both_sides():
    """Each as it is and mirrored about the axis, all else the same; only if it is asked for."""
    heard = marks(0.002)
    both = Sonar(SensorConfig(array='linear', both_sides=True)).heard(heard)
    np.testing.assert_allclose(both.bearing[0::2], FROM_AXIS)
    np.testing.assert_allclose(both.bearing[1::2], -FROM_AXIS)
    np.testing.assert_allclose(both.bearing_sd, 0.002)
    assert len(both.time) == len(both.snr) == 2 * len(heard)
    assert Sonar(SensorConfig(array='linear')).heard(heard) is heard


@pytest.mark.parametrize(
    'wrong', [{'sensor.array': 'omnidirectional'}, {'sensor.sector_width': 2.8}]
)
def test_both_sides_are_refused_where_they_make_no_sense(wrong):
    """Of an array that knows the side, or one that hears one side only."""
    values = {'sensor.array': 'linear', 'sensor.both_sides': True, **wrong}
    with pytest.raises(ValueError, match='both_sides goes with array linear'):
        with_values(SonarTrackerConfig(), values)
