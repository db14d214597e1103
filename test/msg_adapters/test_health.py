# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what the diagnostics say of an input that has fallen silent."""

from dataclasses import replace
import logging

import pytest

from msg_adapters.live.health import Health
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session


@pytest.fixture
def session(types):
    """Return a session of a radar whose own ship may be silent for eight seconds."""
    node_config = replace(radar_node_config(), ownship_timeout=8.0)
    return radar_session(RadarTrackerConfig(), node_config, types, logging.getLogger('health'))


def test_level_says_for_how_long_no_plots_have_come(session):
    """Since the last ones, or since the node became active."""
    health = Health(started=100.0)
    assert health.level(session, 104.0) == ('OK', 'tracking')
    assert health.level(session, 112.0) == ('WARN', 'no plots for 12 s')
    health.plots_at = 111.0
    assert health.level(session, 112.0) == ('OK', 'tracking')
    assert health.level(session, 123.2) == ('WARN', 'no plots for 12 s')


def test_level_says_for_how_long_own_ship_is_silent_where_it_is_needed(session):
    """A sensor that stands still has none; one that moves cannot do without."""
    health = Health(started=0.0, plots_at=99.0, ownship_at=85.0)
    assert health.level(session, 100.0) == ('OK', 'tracking')
    session.frame.check_ownship('odom')
    session.frame.check_plots('radar')
    assert health.level(session, 100.0) == ('WARN', 'no ownship for 15 s')
    health.ownship_at = 93.0
    assert health.level(session, 100.0) == ('OK', 'tracking')
