# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Replay of a bag in which own ship's odometry comes late, and ends early."""

import numpy as np
import pytest

from benchmarks.late_odometry import contacts, messages, odometry, PERIOD, plots_of, VALUES
from tracking_tools.bags import BagWriter, nanoseconds, open_bag
from tracking_tools.parameter_file import configure
from tracking_tools.replay import replay
from tracking_tools.scenarios.messages import EPOCH
from tracking_tools.sensors import SENSORS

TURNS, PARTS, LATE = 8, 8, 0.7  # s that odometry of 2 Hz is late
VALUES = {**VALUES, 'scan.assembly': 'sector', 'ownship_timeout': 60.0}


@pytest.fixture
def record(tmp_path):
    """Return a function that records a ship whose odometry ends at a time [s]."""

    def record(end):
        rng = np.random.default_rng(1)
        told = [(t + LATE, 'ownship', odometry(t)) for t in np.arange(-1.0, end, 0.5)]
        seen = [
            (e.received, 'plots', e.msg) for e in messages(*plots_of(rng, *contacts(rng)), PARTS)
        ]
        seen = [event for event in seen if event[0] <= TURNS * PERIOD]
        with BagWriter(tmp_path / 'bag') as out:
            for time, topic, msg in sorted([*told, *seen], key=lambda event: event[0]):
                out.write(topic, msg, nanoseconds(EPOCH + time))
        return tmp_path / 'bag'

    return record


def tables(bag, output):
    """Replay; return the summary, the stamps of the tables and when they came [s]."""
    summary = replay(bag, output, configure(SENSORS['radar'].configs, VALUES), quiet=True)
    found = []
    with open_bag(output) as reader:
        for connection, time, raw in reader.messages():
            stamp = reader.deserialize(raw, connection.msgtype).header.stamp
            found.append((stamp.sec + 1e-9 * stamp.nanosec, 1e-9 * time - EPOCH))
    stamps, came = np.array(found).T
    return summary, stamps - stamps[0], came


def test_plots_that_wait_at_the_end_are_not_left_out(record, tmp_path):
    """Odometry of their time was never recorded."""
    summary, stamps, came = tables(record(TURNS * PERIOD), tmp_path / 'tracks')
    np.testing.assert_allclose(stamps, np.arange(TURNS * PARTS) * PERIOD / PARTS, atol=1e-6)
    waited = came - stamps - PERIOD / PARTS
    assert waited[PARTS:-PARTS].min() > LATE - 0.5
    assert waited.max() <= LATE + 0.5 + 1e-6
    assert (np.diff(came) >= 0.0).all()
    assert 'in vain' not in str(summary)


def test_plots_wait_as_long_as_they_may_where_the_odometry_ends(record, tmp_path):
    """Then they are used one after the other, and how many is told."""
    summary, stamps, came = tables(record(0.5 * TURNS * PERIOD), tmp_path / 'tracks')
    assert len(stamps) == TURNS * PARTS
    waited = came - stamps - PERIOD / PARTS
    step = PERIOD / PARTS  # a replay looks at what waits when the next message comes
    assert 2.0 < waited.max() < 2.0 + step + 1e-6
    assert (waited[-PARTS:] < 1e-6).all()
    assert 0 < summary.plots.in_vain < 2.5 / step
    assert f'waited in vain for own ship: {summary.plots.in_vain} messages' in str(summary)
