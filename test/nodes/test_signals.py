# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
A node ends with 0 and without a word, however often and whenever it is told to stop.

From the first line of our program on, that is: while Python itself starts (some 0.1 s), its own
habits hold, a traceback after SIGINT and death by SIGTERM.
"""

from pathlib import Path
from signal import SIGINT, SIGTERM
import sys
import time

import numpy as np
import pytest

from tracking_tools.testing import NodeProcess

ROOT = Path(__file__).parents[2]
START = 1.5  # s after our first line, when a node is up unless the machine is very busy
BURST = 0.15  # s from the first to the last signal


# rclpy wakes the executor first, which may sleep again before its context is shut down.
UNTOLD = """
import sys
from threading import Timer
from tracking_node.run import run
from radar_tracker import live

def make_node():
    node = live.make_node()
    Timer(1.0, node.context.handle.shutdown).start()
    return node

sys.exit(run(make_node))
"""


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes."""
    return request.getfixturevalue(request.param)


def wait_until_handled(node):
    """Wait until our program has taken SIGTERM over: its first line."""
    status = Path(f'/proc/{node.process.pid}/status')
    end = time.monotonic() + 20.0
    while True:
        caught = next(
            line for line in status.read_text().splitlines() if line.startswith('SigCgt')
        )
        if int(caught.split()[1], 16) >> (SIGTERM - 1) & 1:
            return
        node.check()
        assert time.monotonic() < end, 'SIGTERM is not handled'


def stop(node, signals, moments):
    """Send signals at moments after now [s]; return the exit code."""
    begun = time.monotonic()
    for number, moment in zip(signals, np.sort(moments), strict=True):
        while time.monotonic() - begun < moment and node.process.poll() is None:
            time.sleep(0.001)  # the moment is what is tested
        if node.process.poll() is not None:
            break
        node.signal(number)
    return node.wait()


@pytest.mark.parametrize(
    'signals',
    [[SIGINT], [SIGTERM], [SIGINT] * 2, [SIGINT, SIGTERM], [SIGTERM, SIGINT] * 3],
    ids=lambda signals: '-'.join(number.name for number in signals),
)
@pytest.mark.parametrize('sensor', ['radar'], indirect=True)
def test_signals_while_running_end_the_node_with_zero(start_node, probe, signals):
    """However often a user or a launch file insists."""
    node = start_node()
    probe.meet()
    assert stop(node, signals, np.zeros(len(signals))) == 0
    assert 'Traceback' not in node.log


def test_end_that_nobody_told_the_executor_ends_an_idle_node(ros_domain_id, tmp_path):
    """A node that is not configured has no timers of its own that would wake it."""
    command = [sys.executable, '-c', UNTOLD, '--ros-args', '-p', 'autostart:=false']
    with NodeProcess(command, ros_domain_id, tmp_path / 'log', folder=ROOT) as node:
        assert node.wait() == 0
    assert 'Traceback' not in node.log


def check_random_stop(node, seed):
    """Send one to six signals at any moment from our first line until after the start."""
    rng = np.random.default_rng(seed)
    signals = [(SIGINT, SIGTERM)[i] for i in rng.integers(0, 2, rng.integers(1, 7))]
    wait_until_handled(node)
    moments = rng.uniform(0.0, START) + rng.uniform(0.0, BURST, len(signals))
    assert stop(node, signals, moments) == 0, f'seed {seed}: {node.log}'
    assert 'Traceback' not in node.log


@pytest.mark.parametrize('seed', range(2))
def test_signals_while_starting_end_the_node_with_zero(start_node, seed):
    """Imports, parameters, topics: nothing minds being interrupted."""
    check_random_stop(start_node(), seed)


@pytest.mark.soak
@pytest.mark.parametrize('seed', range(2, 102))
def test_signals_at_a_hundred_moments_end_the_node_with_zero(start_node, seed):
    """The same for each node, a hundred times."""
    check_random_stop(start_node(), seed)
