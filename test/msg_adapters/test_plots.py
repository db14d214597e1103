# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Drivers' messages become plots in our conventions; bad rows go alone."""

from dataclasses import dataclass

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.plots import from_plots, to_plots
from msg_adapters.table import from_columns
from tracking_core.batches import Plots


@dataclass(frozen=True)
class Sensor:
    """What the adapter asks of a sensor."""

    angle_unit: str = 'rad'
    azimuth_convention: str = 'enu'
    range_rate_sign: int = 1
    range_min: float = 0.0
    range_max: float = 1e5


def message(types, stamp=100.0, frame='radar', **columns):
    """Return a message with these columns, float64 unless they are arrays."""
    return from_columns({k: np.asarray(v) for k, v in columns.items()}, stamp, frame, types)


POLAR = {'range': [1e3, 2e3], 'azimuth': [0.1, -0.2]}


@pytest.mark.parametrize(
    ('theirs', 'ours'),
    [
        ('rho', 'range'), ('Slant_Range', 'range'), ('theta', 'azimuth'), ('AZ', 'azimuth'),
        ('el', 'elevation'), ('Doppler', 'range_rate'), ('v_r', 'range_rate'),
        ('signal_to_noise_ratio', 'snr'), ('range_std', 'range_sd'), ('sigma_az', 'azimuth_sd'),
        ('elevation_stddev', 'elevation_sd'), ('doppler_std', 'range_rate_sd'),
    ],
)  # fmt: skip
def test_synonym_is_read_whatever_its_case(types, theirs, ours):
    """The names that drivers use are known."""
    columns = {name: values for name, values in POLAR.items() if name != ours}
    reading = to_plots(message(types, **columns, **{theirs: [0.3, 0.4]}), Sensor(), 9)
    np.testing.assert_allclose(getattr(reading.plots, ours), [0.3, 0.4])
    assert reading.mapping[ours] == theirs


def test_own_name_wins_over_a_synonym(types):
    """With both there, the documented name is taken."""
    reading = to_plots(message(types, **POLAR, rho=[7.0, 7.0]), Sensor(), 9)
    np.testing.assert_array_equal(reading.plots.range, POLAR['range'])


def test_override_wins_over_the_own_name(types):
    """The user knows best."""
    msg = message(types, **POLAR, distance_2=[7.0, 8.0])
    reading = to_plots(msg, Sensor(), 9, {'range': 'distance_2', 'snr': ''})
    np.testing.assert_array_equal(reading.plots.range, [7.0, 8.0])


def test_override_of_a_field_that_is_not_there_is_refused(types):
    """The parameter and the fields that are there are named."""
    with pytest.raises(BadMessage, match=r'dist \(parameter fields.range\).*range, azimuth'):
        to_plots(message(types, **POLAR), Sensor(), 9, {'range': 'dist'})


def test_missing_field_is_named_with_those_that_are_there(types):
    """A message without azimuth says so."""
    with pytest.raises(BadMessage, match=r'azimuth is missing.*fields are: range, snr'):
        to_plots(message(types, range=[1.0], snr=[2.0]), Sensor(), 9)


def test_message_without_rows_is_a_scan_that_saw_nothing(types):
    """No rows need no fields."""
    reading = to_plots(message(types, unknown=np.zeros(0)), Sensor(), 9)
    assert len(reading.plots) == 0
    assert reading.plots.stamp == 100.0
    assert reading.plots.frame == 'radar'


def test_compass_azimuth_becomes_anticlockwise_from_east(types):
    """North is pi / 2, east 0, west +-pi, south -pi / 2."""
    compass = np.deg2rad([0.0, 90.0, 180.0, 270.0])
    msg = message(types, range=np.ones(4), azimuth=compass)
    azimuth = to_plots(msg, Sensor(azimuth_convention='compass'), 9).plots.azimuth
    np.testing.assert_allclose(np.cos(azimuth), [0.0, 1.0, 0.0, -1.0], atol=1e-12)
    np.testing.assert_allclose(np.sin(azimuth), [1.0, 0.0, -1.0, 0.0], atol=1e-12)
    assert np.all((azimuth >= -np.pi) & (azimuth < np.pi))


def test_clockwise_azimuth_is_counted_from_ahead(types):
    """Ahead is 0, starboard negative, port positive, as in the bearings of a sonar."""
    msg = message(types, range=np.ones(3), azimuth=np.deg2rad([0.0, 90.0, 300.0]))
    azimuth = to_plots(msg, Sensor(azimuth_convention='clockwise'), 9).plots.azimuth
    np.testing.assert_allclose(azimuth, np.deg2rad([0.0, -90.0, 60.0]), atol=1e-12)


def test_degrees_are_read_where_the_user_says_so(types):
    """Unit first, then convention: 300 degrees clockwise from ahead is 60 to port."""
    msg = message(types, range=[1e3, 1e3], azimuth=[300.0, 5.0], azimuth_sd=[0.3, 0.3])
    sensor = Sensor(angle_unit='deg', azimuth_convention='clockwise')
    plots = to_plots(msg, sensor, 9).plots
    np.testing.assert_allclose(plots.azimuth, np.deg2rad([60.0, -5.0]))
    np.testing.assert_allclose(plots.azimuth_sd, np.deg2rad(0.3))
    with pytest.raises(BadMessage, match='angle_unit'):
        to_plots(msg, Sensor(), 9)


def test_azimuth_beyond_half_a_turn_is_wrapped(types):
    """Sensors that count from 0 to 2 pi give the same directions."""
    msg = message(types, range=np.ones(2), azimuth=[1.5 * np.pi, -1.5 * np.pi])
    np.testing.assert_allclose(to_plots(msg, Sensor(), 9).plots.azimuth, [-np.pi / 2, np.pi / 2])


def test_range_rate_sign_is_applied(types):
    """Sensors that call approaching positive are turned round."""
    msg = message(types, **POLAR, range_rate=[5.0, np.nan])
    plots = to_plots(msg, Sensor(range_rate_sign=-1), 9).plots
    np.testing.assert_array_equal(plots.range_rate, [-5.0, np.nan])


def test_velocity_is_ambiguous_until_the_user_says(types):
    """The field is noted, not taken; an override takes it."""
    msg = message(types, **POLAR, velocity=[5.0, 6.0])
    reading = to_plots(msg, Sensor(), 9)
    assert np.isnan(reading.plots.range_rate).all()
    assert 'fields.range_rate: velocity' in reading.note
    told = to_plots(msg, Sensor(), 9, {'range_rate': 'velocity'})
    np.testing.assert_array_equal(told.plots.range_rate, [5.0, 6.0])
    assert told.note == ''


@pytest.mark.parametrize(
    'time',
    [
        np.array([0.5, -0.25], np.float32),
        np.array([1_700_000_000.5, 1_699_999_999.75]),
    ],
    ids=['offset', 'absolute'],
)
def test_time_is_an_offset_or_absolute(types, time):
    """Seconds after the stamp, or, in float64 beyond 1e8, since the epoch."""
    plots = to_plots(message(types, stamp=1.7e9, **POLAR, time=time), Sensor(), 9).plots
    np.testing.assert_allclose(plots.time - 1.7e9, [0.5, -0.25], atol=1e-6)


def test_one_absurd_time_does_not_change_what_the_others_mean(types):
    """Each row is an offset or absolute by itself."""
    msg = message(types, range=np.ones(3), azimuth=np.ones(3), time=[0.5, 1e30, 0.25])
    np.testing.assert_allclose(to_plots(msg, Sensor(), 9).plots.time, [100.5, 100.25])


def test_signalling_nan_is_a_nan_like_any_other(types):
    """Arithmetic on such bits warns, and a warning ends whoever makes warnings errors."""
    signal = np.array([0x7FF4000000000000], np.uint64).view(np.float64)[0]
    msg = message(types, range=np.ones(2), azimuth=np.ones(2), time=[signal, 0.25])
    np.testing.assert_allclose(to_plots(msg, Sensor(), 9).plots.time, [100.25])


def test_whole_number_time_is_nanoseconds(types):
    """A uint32 t counts nanoseconds after the stamp."""
    msg = message(types, **POLAR, t=np.array([0, 500_000_000], np.uint32))
    np.testing.assert_allclose(to_plots(msg, Sensor(), 9).plots.time, [100.0, 100.5])


@pytest.mark.parametrize(
    ('name', 'value', 'reason'),
    [
        ('range', np.nan, 'range is not a number'),
        ('range', np.inf, 'range is not a number'),
        ('range', -1.0, 'range is negative'),
        ('range', 2e5, 'range beyond range_max'),
        ('range', 5.0, 'range below range_min'),
        ('azimuth', np.nan, 'azimuth is not a number'),
        ('azimuth', 1e4, 'azimuth beyond 2 pi'),
        ('elevation', np.inf, 'elevation beyond'),
        ('elevation', 30.0, 'elevation beyond'),
        ('time', 3600.0, 'time more than 60 s off'),
        ('time', np.nan, 'time is not a number'),
    ],
)
def test_bad_row_is_dropped_and_counted(types, name, value, reason):
    """The bad row goes, its neighbour stays, the reason is counted."""
    columns = {**POLAR, 'elevation': [0.1, 0.1], 'time': [0.0, 0.0]}
    columns[name] = [columns[name][0], value]
    reading = to_plots(message(types, **columns), Sensor(range_min=10.0), 9)
    assert len(reading.plots) == 1
    ((said, count),) = reading.dropped.items()
    assert reason in said
    assert count == 1


def test_plot_without_height_stays_beside_plots_that_have_one(types):
    """A secondary radar hears a height or not, plot by plot."""
    reading = to_plots(message(types, **POLAR, elevation=[0.1, np.nan]), Sensor(), 9)
    np.testing.assert_allclose(reading.plots.elevation, [0.1, np.nan])
    assert not reading.dropped


def test_elevation_of_nan_throughout_is_not_measured(types):
    """A 2-D radar that fills the column with NaN loses no plots."""
    reading = to_plots(message(types, **POLAR, elevation=[np.nan, np.nan]), Sensor(), 9)
    assert len(reading.plots) == 2


def test_noise_that_cannot_be_is_not_used(types):
    """Zero, negative and infinite noise is counted and becomes NaN; NaN is just unknown."""
    msg = message(
        types, range=np.ones(5), azimuth=np.ones(5), range_sd=[0.0, -1.0, np.inf, np.nan, 5.0]
    )
    reading = to_plots(msg, Sensor(), 9)
    np.testing.assert_array_equal(reading.plots.range_sd, [np.nan] * 4 + [5.0])
    assert sum(reading.doubtful.values()) == 3


def test_absurd_range_rate_is_not_used(types):
    """The plot is kept without it: a likelihood of zero would spoil its tracks."""
    reading = to_plots(message(types, **POLAR, range_rate=[1e300, 5.0]), Sensor(), 9)
    np.testing.assert_array_equal(reading.plots.range_rate, [np.nan, 5.0])
    assert reading.doubtful == {'range_rate outside [-10000, 10000]': 1}


def test_polar_wins_over_cartesian_and_contradictions_are_counted(types):
    """Both there: range and azimuth are used; a row that says two things is counted."""
    msg = message(types, range=[1e3, 1e3], azimuth=[0.0, 0.0], x=[1e3, 0.0], y=[0.0, 1e3])
    reading = to_plots(msg, Sensor(), 9)
    assert np.isnan(reading.plots.position).all()
    assert reading.doubtful == {'polar and x, y disagree': 1}


def test_cartesian_plots_are_read(types):
    """Without polar columns positions are used; z may be missing."""
    plots = to_plots(message(types, x=[3.0], y=[4.0]), Sensor(), 9).plots
    np.testing.assert_array_equal(plots.position, [[3.0, 4.0, np.nan]])
    assert np.isnan(plots.range).all()


def test_field_with_a_count_is_refused_where_one_number_belongs(types):
    """A matrix is no range."""
    with pytest.raises(BadMessage, match='field range has count 2'):
        to_plots(message(types, range=np.ones((1, 2)), azimuth=[1.0]), Sensor(), 9)


def test_huge_values_do_no_harm(types):
    """Numbers at the edge of the format are dropped without a warning."""
    huge = [1e308, -1e308, 1.0]
    assert len(to_plots(message(types, x=huge, y=huge), Sensor(), 9).plots) == 1
    assert len(to_plots(message(types, range=huge, azimuth=huge), Sensor(), 9).plots) == 1
    polar = {'range': np.ones(3), 'azimuth': np.ones(3)}
    most = np.full(3, np.finfo(np.float64).max)
    assert len(to_plots(message(types, **polar, x=most, y=most), Sensor(), 9).plots) == 3


def test_message_of_bad_rows_only_is_refused(types):
    """It is no scan that saw nothing; but plots out of range only are one."""
    nans = message(types, range=[np.nan, -1.0], azimuth=[0.0, 0.0])
    with pytest.raises(BadMessage, match=r'none of 2 rows.*not a number \(1\).*negative \(1\)'):
        to_plots(nans, Sensor(), 9)
    far = message(types, range=[2e5], azimuth=[0.0])
    assert len(to_plots(far, Sensor(), 9).plots) == 0


@pytest.mark.parametrize('columns', [('range', 'azimuth'), ('x', 'y', 'z')])
def test_cloud_of_no_points_is_a_scan_that_saw_nothing_where_it_says_so(types, columns):
    """Organised clouds have NaN where nothing is, and is_dense false: else tracks never end."""
    msg = message(types, **{name: [np.nan] * 4 for name in columns})
    with pytest.raises(BadMessage, match='none of 4 rows'):
        to_plots(msg, Sensor(), 9)
    msg.is_dense = False
    reading = to_plots(msg, Sensor(), 9)
    assert (len(reading.plots), reading.plots.stamp) == (0, 100.0)
    assert reading.dropped == {f'{columns[0]} is not a number': 4}


def test_from_plots_and_back_is_the_same(types):
    """What a simulator writes is what the tracker reads."""
    plots = Plots.polar(
        np.array([100.5, 101.0]), np.array([1e3, 2e3]), np.array([0.1, -3.0]),
        snr=np.array([20.0, 21.0]), stamp=100.0, frame='radar',
    )  # fmt: skip
    back = to_plots(from_plots(plots, types), Sensor(), 9).plots
    for name in ('time', 'range', 'azimuth', 'snr'):
        np.testing.assert_allclose(getattr(back, name), getattr(plots, name), rtol=1e-6)
    assert np.isnan(back.elevation).all()
    assert (back.stamp, back.frame) == (100.0, 'radar')
