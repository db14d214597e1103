# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Shipped parameter files say only what exists and what is allowed."""

from pathlib import Path

import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import RadarNodeConfig
from tracking_core.config import parameters, with_values

yaml = pytest.importorskip('yaml')
FILES = sorted(Path(__file__).parents[2].joinpath('config').glob('*.yaml'))


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
    for config in (RadarTrackerConfig(), RadarNodeConfig()):
        own = {p.name: left.pop(p.name) for p in parameters(config) if p.name in left}
        with_values(config, own)
    assert not left


def test_names_of_tracker_and_node_do_not_collide():
    """One file serves both configs."""
    tracker = {p.name for p in parameters(RadarTrackerConfig())}
    assert not tracker & {p.name for p in parameters(RadarNodeConfig())}
