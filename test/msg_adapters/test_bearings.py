# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A sonar's messages become marks in our conventions; bad rows go alone."""

from dataclasses import dataclass

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.bearings import to_bearings
from msg_adapters.table import from_columns


@dataclass(frozen=True)
class Sensor:
    """What the adapter asks of a sonar."""

    angle_unit: str = 'rad'
    azimuth_convention: str = 'enu'


def message(types, **columns):
    """Return a message with these columns, float64 unless they are arrays."""
    return from_columns({k: np.asarray(v) for k, v in columns.items()}, 100.0, '/array', types)


@pytest.mark.parametrize(
    ('theirs', 'ours'),
    [
        ('bearing', 'bearing'), ('Azimuth', 'bearing'), ('theta', 'bearing'), ('AZ', 'bearing'),
        ('bearing_std', 'bearing_sd'), ('sigma_az', 'bearing_sd'), ('azimuth_sd', 'bearing_sd'),
        ('signal_to_noise_ratio', 'snr'),
    ],
)  # fmt: skip
def test_synonym_is_read_whatever_its_case(types, theirs, ours):
    """The names that drivers use are known."""
    columns = {'bearing': [0.1, 0.2], theirs: [0.3, 0.4]}
    if ours == 'bearing' and theirs != 'bearing':
        del columns['bearing']
    reading = to_bearings(message(types, **columns), Sensor(), 9)
    np.testing.assert_allclose(getattr(reading.plots, ours), [0.3, 0.4])
    assert reading.mapping[ours] == theirs


@pytest.mark.parametrize(
    ('convention', 'given', 'expected'),
    [
        ('enu', [0.1, 3.5, -3.5, np.pi], [0.1, 3.5 - 2 * np.pi, 2 * np.pi - 3.5, -np.pi]),
        ('compass', [0.0, np.pi / 2, 4.0], [np.pi / 2, 0.0, np.pi / 2 - 4.0]),
        ('clockwise', [0.0, np.pi / 2, 6.0], [0.0, -np.pi / 2, 2 * np.pi - 6.0]),
    ],
)
def test_bearings_are_anticlockwise_and_within_a_turn(types, convention, given, expected):
    """From x in [-pi, pi), wherever the sensor counts from."""
    reading = to_bearings(message(types, bearing=given), Sensor(azimuth_convention=convention), 9)
    np.testing.assert_allclose(reading.plots.bearing, expected, atol=1e-12)


def test_bad_rows_go_alone_and_odd_values_count_as_not_told(types):
    """NaN and more than a turn are dropped by reason; an sd of zero is not believed."""
    msg = message(
        types, bearing=[0.1, np.nan, 270.0, 0.4], bearing_sd=[0.0, 0.01, 0.01, 0.02],
        time=[0.0, 0.0, 0.0, 1e3],
    )  # fmt: skip
    reading = to_bearings(msg, Sensor(), 9)
    np.testing.assert_allclose(reading.plots.bearing, [0.1])
    assert np.isnan(reading.plots.bearing_sd).all()
    assert reading.dropped == {
        'bearing is not a number': 1,
        'bearing beyond 2 pi': 1,
        'time more than 60 s off the stamp': 1,
    }
    assert reading.doubtful == {'bearing_sd outside [1e-06, 0.5]': 1}


def test_whole_numbers_of_time_are_nanoseconds(types):
    """As some drivers have it."""
    msg = message(types, bearing=[0.1, 0.2], t=np.array([0, 500_000_000], np.uint32))
    np.testing.assert_allclose(to_bearings(msg, Sensor(), 9).plots.time, [100.0, 100.5])


@pytest.mark.parametrize(
    ('columns', 'words'),
    [
        ({'range': [1.0]}, 'field bearing is missing; fields are: range'),
        ({'bearing': [np.nan, np.inf]}, 'none of 2 rows'),
        ({'bearing': np.zeros(10)}, 'limit 9 rows'),
    ],
)
def test_message_without_a_usable_mark_is_refused(types, columns, words):
    """With what is there, and what would be right."""
    with pytest.raises(BadMessage, match=words):
        to_bearings(message(types, **columns), Sensor(), 9)


def test_cycle_that_heard_nothing_is_legal(types):
    """With columns or without."""
    for columns in ({'bearing': np.zeros(0)}, {'anything': np.zeros(0)}):
        reading = to_bearings(message(types, **columns), Sensor(), 9)
        assert (len(reading.plots), reading.plots.frame) == (0, 'array')
        assert reading.plots.stamp == 100.0
