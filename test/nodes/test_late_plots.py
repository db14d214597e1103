# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The live radar node and plots that come in the wrong order."""

import logging

import numpy as np
from std_srvs.srv import Trigger

from msg_adapters.message_types import rclpy_types, seconds
from msg_adapters.table import to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session

ORDER = [*range(14), 17, 14, 16, 15, 18, 20, 19, 21, 22]
LATE = 4
RELIABLE = 'qos_overrides./plots.subscription.reliability:=reliable'
PERIOD = 4.0


def test_reordered_plots_are_tracked_as_a_replay_does(start_node, probe):
    """Late plots are counted, stamps rise, ids stay, and the bytes are those of a replay."""
    start_node(RELIABLE, 'max_delay:=0.0')
    probe.meet()
    assert probe.call(Trigger, 'radar_tracker/reset', Trigger.Request()).success
    probe.tables.clear()
    begin = probe.stamp + PERIOD
    stamps = [begin + PERIOD * k for k in ORDER]
    sent = [probe.send(probe.sensor.contacts(stamp), stamp) for stamp in stamps]
    probe.spin_until(lambda: len(probe.tables) == len(sent) - LATE, 'all tables')
    probe.spin_until(lambda: probe.diagnosed('plots late, used') == str(LATE), 'late, used')
    assert probe.diagnosed('plots late, dropped') == '0'
    heard = [seconds(table.header.stamp) for table in probe.tables]
    assert (np.diff(heard) > 0.0).all()

    session = radar_session(
        RadarTrackerConfig(), radar_node_config(), rclpy_types(), logging.getLogger('replay')
    )
    replayed = [table for msg in sent if (table := session.plots(msg, 0.0)) is not None]
    assert [bytes(t.data) for t in probe.tables] == [bytes(t.data) for t in replayed]
    tables = [to_columns(table, 10_000) for table in (probe.tables[12], probe.tables[-1])]
    before, after = (set(t['id'][t['status'] == 1].tolist()) for t in tables)
    assert len(before) == 3
    assert before == after


def test_plots_that_are_too_late_are_dropped_and_counted(start_node, probe):
    """Four scans late; the tracks live on."""
    start_node(RELIABLE)
    probe.meet()
    table = probe.confirmed()
    probe.send(probe.sensor.contacts(probe.stamp - 4.5 * PERIOD), probe.stamp - 4.5 * PERIOD)
    probe.spin_until(lambda: probe.diagnosed('plots late, dropped') == '1', 'late, dropped')
    after = probe.scan()
    assert set(table['id'][table['status'] == 1]) == set(after['id'][after['status'] == 1])
