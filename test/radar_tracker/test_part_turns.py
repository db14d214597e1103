# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Messages that are parts of turns, where each is taken for a full one, are told."""

import logging

import numpy as np
import pytest

pytest.importorskip('rosbags')
from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.config import with_values

TURN, CONTACTS, TURNS = 4.0, 16, 12  # [s]


def doubts(parts, assembly, lost=0.0):
    """Return what is doubted of a radar that tells a turn in so many messages, some of them."""
    rng, types = np.random.default_rng(2), rosbags_types()
    config = with_values(RadarTrackerConfig(), {'scan.assembly': assembly})
    radar = radar_session(config, radar_node_config(), types, logging.getLogger('radar'))
    azimuth = np.linspace(0.05, 6.2, CONTACTS)
    place, part = azimuth / (2.0 * np.pi), TURN / parts
    for number in range(TURNS * parts):
        here = (place * parts).astype(int) == number % parts
        if rng.random() < lost:
            continue
        columns = {
            'range': 20e3 + 500.0 * np.flatnonzero(here) + rng.normal(0.0, 50.0, here.sum()),
            'azimuth': azimuth[here] + rng.normal(0.0, 0.00175, here.sum()),
            'time': place[here] * TURN - number % parts * part,
        }
        stamp = 1000.0 + part * number
        radar.plots(from_columns(columns, stamp, 'radar', types), stamp)
    return [doubt.what for doubt in radar.instrument.doubts()]


@pytest.mark.parametrize('parts', [4, 8, 32])
def test_sectors_that_are_taken_for_turns_are_told(parts):
    """Contacts where they are cut are missed else, and nobody hears why."""
    assert doubts(parts, 'message') == ['messages are parts of turns']
    assert doubts(parts, 'sector') == []


@pytest.mark.parametrize('lost', [0.0, 0.3])
def test_turns_are_no_parts(lost):
    """Lost ones make the time between them longer."""
    assert doubts(1, 'message', lost) == []
