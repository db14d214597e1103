# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A session says once what the plots say against the parameters; the diagnostics all the time."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest

pytest.importorskip('rosbags')
from benchmarks.siege import TYPES
from msg_adapters.table import from_columns
from tracking_node.health import Health
from tracking_tools.parameter_file import configure
from tracking_tools.sensors import SENSORS

LOOKS, CONTACTS, PERIOD = 120, 8, 4.0
NOISE = {'range': 50.0, 'azimuth': 0.00175, 'bearing': 0.01}  # the defaults [m], [rad]


class Lines(list):
    """A log that can be read."""

    info = warning = list.append


def heard(sensor, scale=1.0, times=None, own=None, **parameters):
    """Return the lines and the session after scans whose noise is so many times the default."""
    kind, lines, rng = SENSORS[sensor], Lines(), np.random.default_rng(5)
    session = kind.make_session(*configure(kind.configs, parameters), TYPES, lines)
    axes = ('range', 'azimuth') if sensor == 'radar' else ('bearing',)
    sd = {axis: NOISE[axis] * (times or {}).get(axis, 1.0) for axis in axes}
    true = {
        'range': scale * np.linspace(5e3, 4e4, CONTACTS),
        'azimuth': np.linspace(-3.0, 2.9, CONTACTS), 'bearing': np.linspace(-3.0, 2.9, CONTACTS),
    }  # fmt: skip
    for look in range(LOOKS):
        columns = {}
        for axis in axes:
            noise = sd[axis] * (scale if axis == 'range' else 1.0) * rng.normal(size=CONTACTS)
            columns[axis] = (true[axis] + noise).astype(np.float32)
        columns |= {name: np.full(CONTACTS, value, np.float32) for name, value in own or ()}
        stamp = 1e6 + PERIOD * look
        session.plots(from_columns(columns, stamp, sensor, TYPES), stamp)
    doubts = 'scattered', 'sees far', 'has a height'
    return [line for line in lines if any(words in line for words in doubts)], session


@pytest.mark.parametrize('sensor', SENSORS)
def test_noise_as_told_is_not_doubted(sensor):
    """The diagnostics tell how far the plots are scattered, 1: as told."""
    lines, session = heard(sensor)
    assert lines == []
    assert Health(0.0, plots_at=1.0).level(session, 1.0) == ('OK', 'tracking')
    values = Health(0.0).values(session, 1.0)
    told = [value for name, value in values.items() if name.startswith('scatter in ')]
    assert_allclose(told, 1.0, atol=0.3)


@pytest.mark.parametrize(
    ('sensor', 'axis', 'name'),
    [('radar', 'azimuth', 'sensor.azimuth_sd'), ('sonar', 'bearing', 'sensor.bearing_sd')],
)
def test_noise_that_is_told_too_small_is_said_once_with_what_fits(sensor, axis, name):
    """Parameter, what it says, how large it ought to be; in the diagnostics for as long."""
    lines, session = heard(sensor, times={axis: 2.5})
    assert len(lines) == 1
    assert f'in {axis} as {name} = ' in lines[0]
    assert 'set it right' in lines[0]
    level = Health(0.0, plots_at=1.0).level(session, 1.0)
    assert level == ('WARN', f'{name} is too small')


def test_noise_that_plots_tell_themselves_is_named_as_theirs():
    """The parameter is not what is wrong then."""
    own = [('azimuth_sd', NOISE['azimuth'])]
    lines, _ = heard('radar', times={'azimuth': 4.0}, own=own)
    assert len(lines) == 1
    assert 'in azimuth as azimuth_sd of the plots tells' in lines[0]


def test_a_radar_that_sees_no_farther_than_its_noise_is_doubted():
    """People within 40 m: the default makes no track of them, and says why."""
    lines, session = heard('radar', scale=1e-3)
    assert len(lines) == 1
    assert lines[0].startswith('sensor.range_sd = 50 m is that of a radar')
    assert Health(0.0, plots_at=1.0).level(session, 1.0)[1] == 'sensor.range_sd is too large'
    lines, _ = heard('radar', scale=1e-3, **{'sensor.range_sd': 0.2})
    assert lines == []


@pytest.mark.parametrize('tells', [False, True])
def test_a_3d_radar_without_heights_is_doubted(tells):
    """A preset of another radar, or a field of another name: else nobody hears why no track is."""
    heights = [('elevation', 0.1)] if tells else None
    lines, session = heard('radar', own=heights, **{'sensor.dimensions': 3})
    assert bool(len(session.tracks)) == tells
    assert len(lines) == (not tells)
    level = Health(0.0, plots_at=1.0).level(session, 1.0)
    assert level == (('OK', 'tracking') if tells else ('WARN', 'no plot has a height'))
