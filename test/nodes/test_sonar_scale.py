# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The sonar node with a hundred contacts and fifty false marks a cycle, for an hour at 1 Hz."""

import os
from pathlib import Path

import numpy as np
import pytest

from tracking_tools.testing import confirmed_ids, SONAR, SyntheticSensor
from tracking_tools.testing.synthetic import START

CONTACTS, FALSE, SEEN = 100, 50, 0.9
DEGREE = np.pi / 180.0
PARAMETERS = ('sensor.bearing_sd:=0.004', 'initiation.rate_sd:=0.0003')
SETTLED = 300  # cycles until the hundred contacts are tracks and all buffers are full
REPORT = 300  # cycles
GROWTH = 3.0  # MB that may come later: the allocator's, not a buffer's
TICKS = os.sysconf('SC_CLK_TCK')


def marks(stamp):
    """Return nine tenths of the contacts, which drift at up to 36 degrees an hour, and clutter."""
    since = stamp - START
    rng = np.random.default_rng(round(since * 1000) % 2**32)
    number = np.arange(CONTACTS)
    bearing = 360.0 / CONTACTS * number + 0.01 * np.sin(7.0 * number) * since
    bearing = bearing * DEGREE + rng.normal(0.0, 0.004, CONTACTS)
    heard = bearing[rng.random(CONTACTS) < SEEN]
    every = np.concatenate([heard, rng.uniform(-np.pi, np.pi, FALSE)])
    return {'bearing': np.angle(np.exp(1j * rng.permutation(every))).astype(np.float32)}


@pytest.fixture
def sensor():
    """Return the sonar of this test, a cycle a second."""
    return SyntheticSensor('sonar_tracker', 'bearings', SONAR.frame, marks, CONTACTS, 1.0)


def memory(pid):
    """Return the resident memory of a process [MB]."""
    lines = Path('/proc', str(pid), 'status').read_text().splitlines()
    return int(next(line for line in lines if line.startswith('VmRSS')).split()[1]) / 1024.0


def spent(pid):
    """Return the CPU time of a process [s]."""
    fields = Path('/proc', str(pid), 'stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


@pytest.mark.skipif(not Path('/proc/self/status').exists(), reason='needs /proc')
@pytest.mark.parametrize('cycles', [150, pytest.param(3600, marks=pytest.mark.soak)])
def test_a_hundred_contacts_in_clutter_take_no_more_memory_with_time(start_node, probe, cycles):
    """Every cycle is answered, the contacts are tracks, and memory stays."""
    pid = start_node(*PARAMETERS).process.pid
    probe.meet()
    probe.reset()
    begun, sizes = spent(pid), []
    for cycle in range(1, cycles + 1):
        table = probe.scan()
        probe.tables.clear()
        probe.diagnostics.clear()
        sizes.append(memory(pid))
        if cycle % REPORT == 0 or cycle == cycles:
            cost = 1e3 * (spent(pid) - begun) / cycle
            held = len(confirmed_ids(table))
            print(f'cycle {cycle}: {held} tracks, {sizes[-1]:.1f} MB, {cost:.1f} ms CPU a cycle')
    assert abs(len(confirmed_ids(table)) - CONTACTS) <= 0.1 * CONTACTS
    settled = min(SETTLED, cycles // 2)
    assert max(sizes[settled:]) - max(sizes[:settled]) < GROWTH
