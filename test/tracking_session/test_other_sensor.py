# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Whoever gives a tracker the other sensor's parameters is told so."""

from pathlib import Path

import pytest

from tracking_core.config import parameters
from tracking_session.other_sensor import other_sensor
from tracking_tools.parameter_file import read_parameter_file
from tracking_tools.sensors import SENSORS

KNOWN = {
    kind: {entry.name for config in sensor.configs for entry in parameters(config)}
    for kind, sensor in SENSORS.items()
}
PRESETS = sorted((Path(__file__).parents[2] / 'config').glob('*.yaml'))


@pytest.mark.parametrize('path', PRESETS, ids=lambda path: path.stem)
def test_other_sensor_knows_every_shipped_file(path):
    """Nothing is said to its own sensor, and whose it is to the other."""
    given = read_parameter_file(path, '/any')
    own = 'radar' if given.keys() <= KNOWN['radar'] else 'sonar'
    other = 'sonar' if own == 'radar' else 'radar'
    assert other_sensor(given, KNOWN[own]) == ''
    assert f'; the {own} tracker has' in other_sensor(given, KNOWN[other])


def test_other_sensor_says_nothing_of_names_that_nobody_has():
    """Nor of a slip in one of its own: that has a nearest name."""
    assert other_sensor(['zzz', 'sensor.range_std', 'scan.late'], KNOWN['radar']) == ''
