# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Shipped parameter files say only what exists and what is allowed."""

from pathlib import Path

import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from tracking_core.config import parameters, with_values

yaml = pytest.importorskip('yaml')
CONFIG = Path(__file__).parents[1] / 'config'
SONAR = {'sonar', 'passive_linear_array', 'direction_finder', 'camera'}
FILES = sorted(CONFIG.glob('*.yaml'))
CONFIGS = {
    'radar': (RadarTrackerConfig(), radar_node_config()),
    'sonar': (SonarTrackerConfig(), sonar_node_config()),
}


def flat(tree, prefix=''):
    """Return the leaves of nested mappings by dotted name."""
    leaves = {}
    for name, value in tree.items():
        nested = flat(value, f'{prefix}{name}.') if isinstance(value, dict) else None
        leaves.update({prefix + name: value} if nested is None else nested)
    return leaves


@pytest.mark.parametrize('path', FILES, ids=lambda path: path.stem)
def test_shipped_file_has_known_names_and_allowed_values(path):
    """Keyed to any node; every name is a parameter and every value passes its checks."""
    tree = yaml.safe_load(path.read_text(encoding='utf-8'))
    assert list(tree) == ['/**']
    given = flat(tree['/**']['ros__parameters'])
    left = dict(given)
    for config in CONFIGS['sonar' if path.stem in SONAR else 'radar']:
        own = {p.name: left.pop(p.name) for p in parameters(config) if p.name in left}
        with_values(config, own)
    assert not left


@pytest.mark.parametrize('sensor', CONFIGS)
def test_names_of_tracker_and_node_do_not_collide(sensor):
    """One file serves both configs."""
    tracker, node = ({p.name for p in parameters(config)} for config in CONFIGS[sensor])
    assert not tracker & node
