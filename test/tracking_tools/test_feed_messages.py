# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""However reports are put into datagrams, the tracker uses each of them once, at its time."""

from collections import Counter
from logging import getLogger

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from radar_tracker.config import RadarTrackerConfig, ScanConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_tools.feeds.feed import Feed
from tracking_tools.feeds.report import Report

TYPES = rosbags_types()
TURN, TICK = 4.0, 1.0 / 128.0  # s; what ASTERIX counts time in
CONTACTS = [0.3, 0.3, 1.1, 2.0, 2.9, 3.7, 4.4, 5.2]  # rad; two in one direction
MARKS = [Report('radar', 0.125 * step) for step in range(32)]  # of a turn


def antenna(turns):
    """Yield datagrams (lists of reports): sector marks, and each plot alone."""
    plots = [
        Report('radar', round(a / (2.0 * np.pi) * TURN / TICK) * TICK, 20e3 + 2e3 * n, -a)
        for n, a in enumerate(CONTACTS)
    ]
    for turn in range(turns):
        for report in sorted(MARKS + plots, key=lambda report: report.time_of_day):
            yield [report._replace(time_of_day=report.time_of_day + turn * TURN)]


def told(datagrams):
    """Return the messages of these, and the feed."""
    feed = Feed(lambda reports, _: reports, TYPES, 'radar', 0.0)
    return [msg for _, msg in filter(None, map(feed.take, datagrams))], feed


def tracked(messages):
    """Return the session of a radar that has used these."""
    config = RadarTrackerConfig(scan=ScanConfig(assembly='sector'))
    radar = radar_session(config, radar_node_config(), TYPES, getLogger('feed'))
    for msg in messages:
        radar.plots(msg, 0.0)
    return radar


def test_plots_that_come_one_by_one_are_all_used():
    """A plot alone, at the time of a mark or of another plot: it is not refused, nor a sector."""
    messages, _ = told(antenna(10))
    radar = tracked(messages)
    assert radar.counts['plots'].refused == Counter()
    assert radar.tracks.confirmed.sum() == len(CONTACTS)


def test_plots_may_come_long_after_the_marks_of_their_time():
    """A radar sends marks at once, plots when they are made; seven marks later from the first."""

    def sent(datagram):
        return datagram[0].time_of_day + (0.9 if np.isfinite(datagram[0].range) else 0.0)

    messages, _ = told(sorted(antenna(10), key=sent))
    radar = tracked(messages)
    assert radar.counts['plots'].refused == Counter()
    assert radar.tracks.confirmed.sum() == len(CONTACTS)


@pytest.mark.parametrize('copies', [1, 2, 3])
def test_copies_are_left_out(copies):
    """Two networks carry one radar: the second copy of a datagram tells nothing."""
    messages, feed = told([one for one in antenna(2) for _ in range(copies)])
    assert sum(msg.width for msg in messages) == 2 * len(CONTACTS)
    assert feed.counts['told twice'] == 2 * (copies - 1) * (len(CONTACTS) + len(MARKS))
