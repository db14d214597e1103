# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what the diagnostics say of an input that has fallen silent."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.platform import Platform
from tracking_node.health import Health


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


def test_slow_antenna_is_not_called_silent_between_its_turns(session):
    """Twelve seconds are its turn; two turns without plots are worth a word."""
    health = Health(started=0.0)
    for now in (3.0, 15.0, 27.0):
        health.plots_come(now)
    assert health.level(session, 39.0) == ('OK', 'tracking')
    assert health.level(session, 52.0) == ('WARN', 'no plots for 25 s')
    health.plots_come(1000.0)  # a silence is no turn
    assert health.level(session, 1061.0) == ('WARN', 'no plots for 61 s')


def test_level_says_for_how_long_own_ship_is_silent_where_it_is_needed(session):
    """A sensor that stands still has none; one that moves cannot do without."""
    health = Health(started=0.0, plots_at=99.0, ownship_at=85.0)
    assert health.level(session, 100.0) == ('OK', 'tracking')
    session.frame.check_ownship('odom', 0.0)
    session.frame.check_plots('radar')
    assert health.level(session, 100.0) == ('WARN', 'no ownship for 15 s')
    health.ownship_at = 93.0
    assert health.level(session, 100.0) == ('OK', 'tracking')


def test_level_names_all_that_is_wrong_until_it_was_told(session):
    """What was shed, who else publishes, what was refused and why: the worst first."""
    health = Health(started=0.0, plots_at=99.0)
    session.counts['plots'].received(1, 2)
    session.counts['plots'].refused['stamp not newer'] += 1
    session.counts['ownship'].refused['own ship leaps'] += 1
    session.ledger.shed('plots')
    session.counts['plots'].in_vain += 1
    told = (
        'too slow: only the newest plots are used; several publishers on plots; '
        'ownship refused: own ship leaps; plots refused: stamp not newer; '
        'plots waited in vain for ownship'
    )
    assert health.level(session, 100.0) == ('WARN', told)
    health.told(session)
    assert health.level(session, 100.0) == ('WARN', 'several publishers on plots')
    session.counts['plots'].received(2, 1)
    for orders in ('acquire', 'cancel'):
        session.counts[orders].received(1, 2)  # of several consoles
    assert health.level(session, 100.0) == ('OK', 'tracking')
    health.unheard = ('cancel', 'ownship')
    assert health.level(session, 100.0) == ('WARN', 'no publisher fits on cancel and ownship')


def test_level_says_that_own_ship_contradicts_itself(session):
    """It moves, and its twist is of a ship at rest."""
    health, still = Health(started=0.0, plots_at=99.0), np.zeros((1, 3))
    for time in np.arange(0.0, 40.0, 0.5):
        place, level = np.array([[5.0 * time, 0.0, 0.0]]), np.array([[0.0, 0.0, 0.0, 1.0]])
        sample = Platform(
            np.array([time]), place, level, still, np.zeros((1, 3, 3)), np.zeros(1)
        )  # fmt: skip
        session.whereabouts.take(sample, time)
    assert health.level(session, 100.0) == ('WARN', 'own ship does not move as its twist says')
