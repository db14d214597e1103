# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Degrees are told from radians by the message, not by the row, or by the user."""

import numpy as np
import pytest

from msg_adapters.angles import in_radians
from msg_adapters.bad_message import BadMessage

CONTACTS = {'azimuth': np.array([2.0, 45.0, 300.0]), 'range': np.array([45.0, 2.0, 300.0])}


@pytest.mark.parametrize('name', ['azimuth', 'bearing'])
def test_message_in_degrees_is_refused_whole(name):
    """The row at 2 degrees is not used as 2 rad; the way out is named."""
    with pytest.raises(BadMessage, match=rf'{name} .* in 2 of 3 rows.*sensor.angle_unit to deg'):
        in_radians({name: CONTACTS['azimuth']}, 'rad')


@pytest.mark.parametrize('angles', [
    [0.1, 6.3, -6.3, 3.0],
    [0.1, 0.2, 0.3, 270.0],
    [np.nan, np.inf, 1e30, 0.1],
    [1e30, -1e30],
    [np.nan],
    [],
])  # fmt: skip
def test_bad_rows_among_radians_are_left_to_the_checks_of_rows(angles):
    """Faults are not a unit."""
    read = in_radians({'azimuth': np.array(angles)}, 'rad')
    np.testing.assert_array_equal(read['azimuth'], angles)


def test_user_may_say_that_angles_are_in_degrees():
    """All of them, with their noise; nothing else changes."""
    read = in_radians({**CONTACTS, 'azimuth_sd': np.array([0.5]), 'elevation': np.ones(1)}, 'deg')
    np.testing.assert_allclose(read['azimuth'], np.pi * CONTACTS['azimuth'] / 180.0)
    np.testing.assert_allclose(read['azimuth_sd'], np.pi / 360.0)
    np.testing.assert_allclose(read['elevation'], np.pi / 180.0)
    assert read['range'] is CONTACTS['range']
