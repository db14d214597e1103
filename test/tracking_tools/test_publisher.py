# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the live publisher of scenarios as a process."""

from contextlib import contextmanager
from dataclasses import replace
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from msg_adapters.table import to_columns
from tracking_tools.scenarios import build, plots

MANY_ROWS = 10_000
DEADLINE = 60.0


def stamp_of(header):
    """Header stamp [ns]."""
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


@contextmanager
def listening(domain_id, topics):
    """Node of this process and what it has received by topic."""
    rclpy = pytest.importorskip('rclpy')
    table = pytest.importorskip('sensor_msgs.msg').PointCloud2
    odometry = pytest.importorskip('nav_msgs.msg').Odometry
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = rclpy.create_node('listener', context=context)
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    executor.add_node(node)
    received = {topic: [] for topic in topics}
    for topic, messages in received.items():
        kind = odometry if topic == 'ownship' else table
        node.create_subscription(kind, topic, messages.append, 100)
    try:
        yield executor, received
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)


def spin_until(executor, condition):
    """Spin until it holds; fail at the deadline."""
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, 'deadline passed'
        executor.spin_once(timeout_sec=0.05)


@contextmanager
def simulating(*arguments):
    """Start the command as a process, in the environment of this test; end it in any case."""
    command = [sys.executable, '-m', 'tracking_tools.simulate', *arguments]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


def test_live_publishes_the_scenario(ros_domain_id):
    """All ten turns and their truth arrive, stamped in scenario time from now on; exit code 0."""
    arguments = ('turns', '--live', '--wait', '--rate', '20', '--duration', '40', '--seed', '5')
    with listening(ros_domain_id, ('plots', 'truth')) as (executor, received):
        before = time.time()
        with simulating(*arguments) as process:
            spin_until(executor, lambda: len(received['plots']) == len(received['truth']) == 10)
            spin_until(executor, lambda: process.poll() is not None)
            assert process.returncode == 0
    stamps = np.array([stamp_of(msg.header) for msg in received['plots']]) * 1e-9
    assert before <= stamps[0] <= time.time()
    np.testing.assert_allclose(np.diff(stamps), 4.0, atol=1e-6)
    scenario = replace(build('turns'), duration=40.0)
    for msg, scan in zip(
        received['plots'], plots(scenario, np.random.default_rng(5)), strict=True
    ):
        columns = to_columns(msg, MANY_ROWS)
        assert msg.header.frame_id == 'radar'
        assert list(columns) == ['range', 'azimuth', 'snr', 'time']
        np.testing.assert_array_equal(columns['range'], scan.columns['range'].astype('f4'))
    for msg in received['truth']:
        assert sorted(to_columns(msg, MANY_ROWS)['id']) == [1, 2, 3, 4, 5, 6]


def test_live_publishes_what_a_sonar_hears(ros_domain_id):
    """Twenty cycles of marks, own ship and truth; stamps two seconds apart; exit code 0."""
    arguments = ('sonar_watch', '--live', '--wait', '--rate', '20', '--duration', '40')
    topics = ('ownship', 'truth', 'bearings')
    with (
        listening(ros_domain_id, topics) as (executor, received),
        simulating(*arguments) as process,
    ):
        spin_until(executor, lambda: all(len(received[topic]) == 20 for topic in topics))
        spin_until(executor, lambda: process.poll() is not None)
        assert process.returncode == 0
    for topic in topics:
        stamps = np.array([stamp_of(msg.header) for msg in received[topic]]) * 1e-9
        np.testing.assert_allclose(np.diff(stamps), 2.0, atol=1e-6)
    heard = [to_columns(msg, MANY_ROWS)['bearing'] for msg in received['bearings']]
    assert len(np.concatenate(heard)) >= 20


@pytest.mark.parametrize(
    'signals',
    [[signal.SIGINT], [signal.SIGTERM], [signal.SIGINT] * 2, [signal.SIGINT, signal.SIGTERM]],
    ids=['INT', 'TERM', 'INT INT', 'INT TERM'],
)
def test_live_stops_cleanly(ros_domain_id, signals):
    """One or two signals in the middle of a scene: exit code 0 and no traceback."""
    with (
        listening(ros_domain_id, ('plots',)) as (executor, received),
        simulating('turns', '--live', '--wait', '--rate', '20', '--sectors', '4') as process,
    ):
        spin_until(executor, lambda: len(received['plots']) > 2)
        for each in signals:
            process.send_signal(each)
        _, complaint = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0
        assert 'Traceback' not in complaint


@pytest.mark.parametrize(
    ('ros', 'words'),
    [
        (('-r', 'plots:='), "Couldn't parse remap rule"),
        (('--frob',), "['--frob']: no argument of ROS; remap with -r FROM:=TO"),
        (('--', 'frob'), 'unknown arguments frob: those of ROS come after --ros-args'),
        (('-p', 'use_sim_time:=1'), "'use_sim_time' to '1' of type 'INTEGER', expecting"),
        (('--params-file', 'none.yaml'), 'there is no parameter file none.yaml'),
    ],
)
def test_live_says_which_argument_ros_cannot_take(ros_domain_id, ros, words):
    """In the words of the nodes, and without a traceback."""
    with simulating('turns', '--live', '--ros-args', *ros) as process:
        _, complaint = process.communicate(timeout=DEADLINE)
        assert process.returncode == 2
    assert words in complaint
    assert 'Traceback' not in complaint
