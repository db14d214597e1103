# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Messages with the fields of known drivers connect at the first try, without a parameter."""

import logging

import numpy as np
import pytest

from msg_adapters.bearings import to_bearings
from msg_adapters.plots import to_plots
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.sensor_config import SensorConfig
from radar_tracker.session import radar_session
from sonar_tracker.sensor_config import SensorConfig as SonarConfig

FLOAT, DOUBLE, BYTE, WORD = np.float32, np.float64, np.int8, np.uint32
OURS = {
    'range': 'range r rho distance slant_range',
    'azimuth': 'azimuth azimuth_angle azim az theta',
    'elevation': 'elevation elevation_angle el phi',
    'range_rate': 'range_rate doppler doppler_velocity radial_speed radial_velocity '
    'radar_relative_radial_velocity v_r vr v',
    'snr': 'snr signal_to_noise_ratio amplitude power intensity rcs',
    'time': 'time t time_offset stamp_offset',
    **{
        f'{name}_sd': f'{name}_sd {name}_std {name}_stddev sigma_{name}'
        for name in ('range', 'azimuth', 'elevation', 'range_rate')
    },
}
NAMES = [(ours, theirs) for ours, names in OURS.items() for theirs in names.split()]
SPOT = {'x': 600.0, 'y': 800.0, 'z': 100.0}
POLAR = {'range': 1e3, 'azimuth': 0.9273, 'elevation': 0.1}
# Fields as the drivers name them, in their order, with the type where it is not float32.
LAYOUTS = {
    'nebula ARS548': 'x y z azimuth azimuth_std elevation elevation_std range range_std '
    'range_rate range_rate_std rcs:b measurement_id:w positive_predictive_value:b '
    'classification:b multi_target_probability:b object_id:w ambiguity_flag:b',
    'smartmicro': 'x y z radial_speed power rcs noise snr azimuth_angle elevation_angle range',
    'ars548_ros': 'x y z v r RCS:b azimuth',
    'provizio': 'x y z radar_relative_radial_velocity ground_relative_radial_velocity '
    'signal_to_noise_ratio',
    'Oculii': 'x y z Doppler Power',
    'mmWave': 'x y z intensity velocity',
    'nuScenes': 'x y z dyn_prop:b id:w rcs vx vy vx_comp vy_comp is_quality_valid:b x_rms:b '
    'y_rms:b',
    'uint32 nanoseconds': 'range azimuth t:w',
    'absolute float64 time': 'range azimuth time:d',
}
TYPES = {'': FLOAT, 'b': BYTE, 'w': WORD, 'd': DOUBLE}
VALUES = {
    **SPOT, **POLAR, 'r': 1e3, 'azimuth_angle': 0.9273, 'elevation_angle': 0.1,
    'time': 99.75, 't': 250_000_000, 'azimuth_std': 0.002, 'elevation_std': 0.003,
    'range_std': 7.0, 'range_rate_std': 0.5,
}  # fmt: skip
SPEEDS = {'range_rate', 'radial_speed', 'v', 'radar_relative_radial_velocity', 'Doppler'}


def driver_message(types, layout, stamp):
    """Return one row with the fields of a layout; speeds are 5, whatever else is not known 3."""
    columns = {}
    for field in layout.split():
        name, _, kind = field.partition(':')
        value = VALUES.get(name, 5.0 if name in SPEEDS else 3.0)
        # An absolute time lies beyond 1e8, so the stamp does too.
        value = value - 100.0 + stamp if name == 'time' else value
        columns[name] = np.array([value], TYPES[kind])
    return from_columns(columns, stamp, 'radar', types)


@pytest.mark.parametrize(('ours', 'theirs'), NAMES, ids=[theirs for _, theirs in NAMES])
@pytest.mark.parametrize('change', [str, str.upper, str.title], ids=['', 'upper', 'title'])
def test_every_name_of_the_table_is_read(types, ours, theirs, change):
    """Every synonym in any case arrives as the field that it means."""
    base = {name: np.array([0.2]) for name in ('range', 'azimuth') if name != ours}
    msg = from_columns({**base, change(theirs): np.array([0.4])}, 100.0, 'radar', types)
    plots = to_plots(msg, SensorConfig(), 9).plots
    expected = 100.4 if ours == 'time' else 0.4
    np.testing.assert_allclose(getattr(plots, ours), [expected])


@pytest.mark.parametrize('theirs', ['bearing', *OURS['azimuth'].split()])
@pytest.mark.parametrize('form', ['{}_sd', '{}_std', '{}_stddev', 'sigma_{}'])
def test_every_name_of_a_bearing_and_its_noise_is_read(types, theirs, form):
    """A sonar's bearing has the names of an azimuth."""
    columns = {theirs: np.array([0.3]), form.format(theirs): np.array([0.02])}
    marks = to_bearings(from_columns(columns, 100.0, 'array', types), SonarConfig(), 9).plots
    np.testing.assert_allclose([marks.bearing[0], marks.bearing_sd[0]], [0.3, 0.02])


@pytest.mark.parametrize('layout', LAYOUTS.values(), ids=LAYOUTS)
def test_layout_of_a_driver_is_tracked_at_the_first_try(types, layout):
    """Two messages later there is a track where the plot is; nothing was dropped or doubted."""
    configs = RadarTrackerConfig(), radar_node_config()
    session = radar_session(*configs, types, logging.getLogger('test'))
    for stamp in (1.7e9, 1.7e9 + 1.0, 1.7e9 + 2.0):
        assert session.plots(driver_message(types, layout, stamp), stamp) is not None
    x, _, y, _ = session.tracks.planes[0].mean[0, 0]
    # 0.3 %: azimuth 0.9273 is y / x to four digits; the range of x, y, z is 1005 m.
    np.testing.assert_allclose([x, y], [600.0, 800.0], rtol=6e-3)
    count = session.counts['plots']
    assert not count.refused + count.dropped + count.doubtful


def test_layouts_are_read_to_the_last_field(types):
    """Noise, range rate, level and time of a plot arrive where a driver has them."""
    read = {
        name: to_plots(driver_message(types, layout, 1.7e9), SensorConfig(), 9).plots
        for name, layout in LAYOUTS.items()
    }
    best = read['nebula ARS548']
    noise = [best.range_sd, best.azimuth_sd, best.elevation_sd, best.range_rate_sd]
    np.testing.assert_allclose(np.ravel(noise), [7.0, 0.002, 0.003, 0.5], rtol=1e-6)
    for name in ('nebula ARS548', 'smartmicro', 'ars548_ros', 'provizio', 'Oculii'):
        assert [read[name].range_rate[0], read[name].snr[0]] == [5.0, 3.0]
    assert np.isnan(read['mmWave'].range_rate[0])  # a `velocity` of no known meaning
    np.testing.assert_allclose(read['ars548_ros'].elevation, np.arctan(0.1))  # z is its height
    for name, offset in (('uint32 nanoseconds', 0.25), ('absolute float64 time', -0.25)):
        np.testing.assert_allclose(read[name].time - 1.7e9, [offset])


def test_intensity_of_an_unknown_scale_is_left_alone(types):
    """A driver that counts to 65535 is used as if it told nothing, without a complaint."""
    columns = {**POLAR, 'intensity': 40_000.0}
    msg = from_columns({k: np.array([v]) for k, v in columns.items()}, 100.0, 'radar', types)
    reading = to_plots(msg, SensorConfig(), 9)
    assert np.isnan(reading.plots.snr).all()
    assert not reading.doubtful
