# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters: set by name, checked against type, limits and choices."""

from __future__ import annotations

import re

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from tracking_core.config import coerce, parameters, with_values
from tracking_core.lifecycle_config import GateConfig, MOfNConfig

DEFAULT = RadarTrackerConfig()
NUMBERS = [
    p for p in parameters(DEFAULT)
    if p.low is not None and np.isscalar(p.value) and p.name != 'sensor.range_rate_sign'
]  # fmt: skip


def test_with_values_sets_nested_parameters_and_keeps_the_rest() -> None:
    """An int becomes a float, a list a tuple; the original is not changed."""
    config = with_values(
        DEFAULT,
        {
            'sensor.range_sd': 80,
            'sensor.mount.yaw': 0.5,
            'motion.horizontal.acceleration_sd': [1, 10],
            'association': 'nearest',
        },
    )
    assert config.sensor.range_sd == 80.0
    assert isinstance(config.sensor.range_sd, float)
    assert config.sensor.mount.yaw == 0.5
    assert config.motion.horizontal.acceleration_sd == (1.0, 10.0)
    assert config.association == 'nearest'
    assert config.sensor.azimuth_sd == DEFAULT.sensor.azimuth_sd
    assert DEFAULT.sensor.range_sd == 50.0


@pytest.mark.parametrize(
    ('values', 'message'),
    [
        ({'sensor.range_std': 1.0}, 'unknown parameter sensor.range_std; did you mean sensor.ran'),
        ({'zzz': 1.0}, 'unknown parameter zzz'),
        (
            {'gate.probability': 1.2},
            'gate.probability must be in [0.5, 0.999999], got 1.2',
        ),
        ({'sensor.range_sd': 'far'}, "sensor.range_sd must be a number, got 'far'"),
        ({'sensor.range_sd': True}, 'sensor.range_sd must be a number, got True'),
        ({'sensor.range_sd': float('nan')}, 'sensor.range_sd must be in'),
        ({'association': 'best'}, 'association must be one of jpda, jpda_star, pda'),
        ({'association': 3}, 'association must be one of'),
        (
            {'motion.horizontal.sojourn_time': [10.0]},
            'motion.horizontal: acceleration_sd, sojourn_time and turn_rate must have',
        ),
        ({'motion.horizontal.sojourn_time': [10.0, -1.0]}, 'sojourn_time must be in'),
        ({'motion.vertical.sojourn_time': [1.0] * 3}, 'one value per mode, got 2 and 3'),
        ({'sensor.dimensions': 1}, 'sensor.dimensions must be 0, 2 or 3, got 1'),
        ({'sensor.range_min': 10.0, 'sensor.range_max': 9.0}, 'below range_max = 9.0, got 10.0'),
        ({'m_of_n.hits': 6}, 'm_of_n.hits must be at most looks = 5, got 6'),
    ],
)
def test_with_values_says_what_is_wrong(values, message: str) -> None:
    """Field, allowed and got stand in the error."""
    with pytest.raises(ValueError, match=re.escape(message)):
        with_values(DEFAULT, values)


@pytest.mark.parametrize('name', [p.name for p in NUMBERS])
def test_parameters_refuse_numbers_outside_their_limits(name: str) -> None:
    """Every limit holds: just outside is refused, naming the field."""
    found = {p.name: p for p in NUMBERS}[name]
    kind = type(found.value)
    for value in (kind(found.low - 1), None if found.high is None else kind(found.high + 1)):
        if value is not None:
            with pytest.raises(ValueError, match=f'{name.rsplit(".", maxsplit=1)[-1]} must be'):
                with_values(DEFAULT, {name: value})


def test_parameters_are_told_once_each_with_doc_and_unit() -> None:
    """Names are unique, every one has a meaning; the defaults round trip."""
    found = list(parameters(DEFAULT))
    names = [p.name for p in found]
    assert len(set(names)) == len(names) > 30
    assert all(p.doc for p in found)
    assert {'sensor.range_sd', 'gate.probability', 'motion.horizontal.sojourn_time'} <= set(names)
    assert with_values(DEFAULT, {p.name: p.value for p in found}) == DEFAULT


def test_config_refuses_wrong_construction() -> None:
    """Dataclasses check themselves, however they are made."""
    with pytest.raises(ValueError, match=r'GateConfig.probability must be in'):
        GateConfig(probability=0.0)
    with pytest.raises(ValueError, match=r'at most looks = 2, got 3'):
        MOfNConfig(hits=3, looks=2)


@pytest.mark.parametrize(
    ('value', 'like', 'expected'),
    [
        (3, 1.0, 3.0),
        (np.array([1.0, 2.0]), (0.0,), (1.0, 2.0)),
        (5, (1.0, 2.0), (5.0,)),
        (3, 2, 3),
        ('a', 'b', 'a'),
        (True, 1.0, True),
    ],
)
def test_coerce_takes_the_type_of_the_default(value, like, expected) -> None:
    """Int to float, sequence or scalar to tuple, all else unchanged."""
    result = coerce(value, like)
    assert result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize(
    ('name', 'value', 'message'),
    [
        ('initiation.speed_max', np.inf, 'must be in'),
        ('initiation.speed_max', np.nan, 'must be in'),
        ('sensor.range_sd', 1e300, 'must be in'),
        ('sensor.range_sd', 10**400, 'must be in'),
        ('alpha_beta.alpha', None, 'must be a number'),
        ('alpha_beta.alpha', {'a': 1}, 'must be a number'),
        ('motion.horizontal.acceleration_sd', [1.0] * 100_000, 'takes at most 64 values'),
    ],
)
def test_with_values_refuses_what_no_number_of_the_world_is(name, value, message) -> None:
    """Infinite, beyond arithmetic, or a list whose square no memory holds."""
    with pytest.raises(ValueError, match=message):
        with_values(DEFAULT, {name: value})
