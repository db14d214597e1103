# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Every estimator in the live node, on the shipped recording."""

from itertools import islice
from pathlib import Path

import numpy as np
import pytest
import yaml

from tracking_core.estimators import ESTIMATORS
from tracking_tools.bags import BagWriter, open_bag
from tracking_tools.demo_player import play
from tracking_tools.held import find_holds
from tracking_tools.parameter_file import read_parameter_file
from tracking_tools.scene import read_scene

ROOT = Path(__file__).parents[2]
TURNS = 60  # of 4 s; every aircraft in sight is confirmed long before


@pytest.fixture(scope='module')
def recording(tmp_path_factory):
    """Return the first turns of the demo scene as a bag: plots and truth, one of each a turn."""
    path = tmp_path_factory.mktemp('recording') / 'bag'
    with open_bag(ROOT / 'demo' / 'terminal_area') as bag, BagWriter(path) as out:
        for connection, time, raw in islice(bag.messages(), 2 * TURNS):
            out.write_raw(connection.topic, connection.msgtype, raw, time)
    return path


@pytest.mark.slow
@pytest.mark.parametrize('name', ESTIMATORS)
def test_live_node_holds_real_flights_with_every_estimator(name, recording, tmp_path):
    """Every message is answered, the node ends with 0, and aircraft are held 90 % of the time."""
    values = read_parameter_file(ROOT / 'config' / 'terminal_radar.yaml', '/radar_tracker')
    parameters, log = tmp_path / 'node.yaml', tmp_path / 'node.log'
    parameters.write_text(
        yaml.safe_dump({'/**': {'ros__parameters': {**values, 'estimator': name}}})
    )
    play(recording, tmp_path / 'tracks', parameters, 1e9, log)  # raises if the node fails
    assert 'Traceback' not in log.read_text()
    scene = read_scene(recording, tmp_path / 'tracks')
    assert len(np.unique(scene.published['stamp'])) > TURNS // 2
    assert np.isfinite(scene.published['covariance']).all()
    holds = find_holds(scene)
    duration, share = (np.array([getattr(h, n) for h in holds]) for n in ('duration', 'share'))
    assert duration @ share / duration.sum() >= 0.9
