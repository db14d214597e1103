# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The radar node on a platform that moves, and under simulated time that goes back."""

from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rosgraph_msgs.msg import Clock

from benchmarks.processes import cpu_time
from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns
from tracking_tools.testing import confirmed_ids

SPEED = 15.0  # m/s of own ship, to the north


def odometry(stamp, since):
    """Return where a ship is that heads north; its radar looks along its x axis."""
    msg = Odometry(header=rclpy_types().header(stamp, 'odom'), child_frame_id='base_link')
    msg.pose.pose.position.y = SPEED * (stamp - since)
    msg.pose.pose.orientation.z = msg.pose.pose.orientation.w = float(np.sqrt(0.5))
    msg.twist.twist.linear.x = SPEED
    return msg


def beside(stamp, since):
    """Return the plot of a buoy that lies still, 5 km east and 1 km north of the start."""
    north = 1000.0 - SPEED * (stamp - since)
    distance, direction = np.hypot(5000.0, north), np.arctan2(north, 5000.0)
    azimuth = direction - np.pi / 2.0  # ahead is north
    return {'range': np.array([distance], np.float32), 'azimuth': np.array([azimuth], np.float32)}


@pytest.fixture
def sail(start_node, probe):
    """Start a node whose own ship is known; return it with a function that sends a scan."""
    node = start_node(
        'ownship_timeout:=5.0',
        'qos_overrides./ownship.subscription.reliability:=reliable',
        'sensor.azimuth_sd:=0.001',
    )
    ownship = probe.tell(Odometry, 'ownship')
    probe.meet()
    probe.peer.wait_until_matched(ownship)
    since = probe.stamp
    for before in (0.2, 0.1, 0.0):  # one alone is not believed
        ownship.publish(odometry(since - before, since))
    node.wait_for_line("the tracking frame is 'odom'")

    def send(step=2.0, with_ship=True):
        probe.stamp += step
        if with_ship:
            ownship.publish(odometry(probe.stamp, since))
        probe.send(beside(probe.stamp, since), probe.stamp)

    def scan(step=2.0):
        send(step)
        probe.spin_until(lambda: probe.is_answered(probe.stamp), 'tracks')
        return to_columns(probe.tables[-1], 100)

    return node, send, scan


def test_plots_of_a_moving_sensor_are_tracked_in_the_frame_of_its_odometry(sail, probe):
    """A buoy lies still in the tracking frame, whatever the ship does."""
    _, _, scan = sail
    for _ in range(12):
        table = scan()
    assert probe.tables[-1].header.frame_id == 'odom'
    (row,) = np.flatnonzero(table['status'] == 1)
    assert np.hypot(table['x'][row] - 5000.0, table['y'][row] - 1000.0) < 100.0
    assert table['speed'][row] < 5.0


def test_own_ship_that_stops_is_told_and_may_come_back(sail, probe):
    """Plots that nobody can place are refused, counted and said; then the same track goes on."""
    node, send, scan = sail
    for _ in range(12):
        before = confirmed_ids(scan())
    send(6.0, with_ship=False)
    send(with_ship=False)
    probe.spin_until(lambda: probe.diagnosed('plots refused: own ship stale') == '2', 'count')
    line = node.wait_for_line('plots message refused')
    assert '6 s away from the samples of the platform, limit 5 s' in line
    assert 'plots refused: own ship stale' in probe.diagnostics[-1].status[0].message
    assert confirmed_ids(scan()) == before


def test_recording_with_own_ship_that_begins_anew_resets_once(sail, probe):
    """Own ship and plots go back together: one warning, one jump, and tracks again."""
    node, send, scan = sail
    begin = probe.stamp
    for _ in range(12):
        before = confirmed_ids(scan())
    probe.stamp = begin
    for _ in range(6):  # own ship is believed after three messages, then the plots
        send()
    node.wait_for_line('began anew?')
    for _ in range(12):
        table = scan()
    assert len(confirmed_ids(table)) == 1
    assert not confirmed_ids(table) & before
    assert node.log.count('began anew?') == 1
    probe.spin_until(lambda: probe.diagnosed('clock jumps') == '1', 'clock jumps')


def test_recording_of_a_few_seconds_has_tracks_in_every_round(sail, probe):
    """Shorter than what a stamp may be off: own ship and plots begin anew with the second one."""
    node, send, scan = sail
    probe.reset()
    begin, ids = probe.stamp, set()
    for _ in range(3):
        probe.stamp = begin
        send(0.0)
        for _ in range(9):
            table = scan(1.0)
        (row,) = np.flatnonzero(table['status'] == 1)
        assert np.hypot(table['x'][row] - 5000.0, table['y'][row] - 1000.0) < 100.0
        ids |= confirmed_ids(table)
    assert len(ids) == 3
    assert node.log.count('began anew?') == 2
    probe.spin_until(lambda: probe.diagnosed('plots refused: stamp not newer') == '2', 'count')


def test_tracking_frame_and_mount_place_a_sensor_that_stands(start_node, probe):
    """The tracks are in the frame asked for; a third one is refused with both names."""
    node = start_node(
        'tracking_frame:=map', 'sensor.mount.x:=1000.0', 'sensor.mount.y:=-400.0',
        f'sensor.mount.yaw:={0.5 * np.pi}',
    )  # fmt: skip
    probe.meet()
    table = probe.confirmed()
    assert probe.tables[-1].header.frame_id == 'map'
    plots = probe.sensor.contacts(probe.stamp)
    east = 1000.0 - plots['range'] * np.sin(plots['azimuth'])
    north = -400.0 + plots['range'] * np.cos(plots['azimuth'])
    rows = table['status'] == 1
    apart = np.hypot(table['x'][rows, None] - east, table['y'][rows, None] - north)
    assert apart.min(axis=0).max() < 500.0  # they fly 150 m/s, and are as of their last look
    probe.stamp += 1.0
    probe.send(plots, probe.stamp, 'masthead')
    assert "'masthead', expected 'radar'" in node.wait_for_line('plots message refused')


def test_clock_that_goes_back_begins_anew_at_once(start_node, probe):
    """Under use_sim_time the first plots after the jump are used, with one warning."""
    node = start_node('use_sim_time:=true')
    clock = probe.node.create_publisher(Clock, '/clock', 10)
    probe.meet()
    probe.spin_until(clock.get_subscription_count)
    before = probe.confirmed()
    now = Clock()
    for time in (probe.stamp, probe.stamp - 500.0):
        now.clock = rclpy_types().header(time, '').stamp
        clock.publish(now)
        probe.until_diagnosed_at(time)
    after = probe.scan(probe.stamp - 500.0)
    assert set(after['id'][after['status'] == 2]) >= set(before['id'][before['status'] == 1])
    assert node.log.count('starts anew') == 1


def test_simulated_time_that_does_not_begin_is_told_for_what_it_is(start_node, probe):
    """Stamps are not called wrong because there is no clock, and there are tracks meanwhile."""
    node = start_node('use_sim_time:=true')
    probe.meet()
    missed = 'use_sim_time is true, but nothing has come on /clock; tracking goes by the stamps'
    probe.peer.ask(lambda _: probe.scan(), lambda: missed in node.log, 'a word on /clock')
    assert len(confirmed_ids(probe.scan())) == 3
    assert 'the clock: use_sim_time?' not in node.log
    assert node.log.count(missed) == 1


def test_clock_that_goes_back_takes_own_ship_along(start_node, probe):
    """No plot of the second round is refused for want of own ship."""
    node = start_node(
        'use_sim_time:=true', 'qos_overrides./ownship.subscription.reliability:=reliable',
        'sensor.azimuth_sd:=0.001',
    )  # fmt: skip
    clock, ownship = probe.tell(Clock, '/clock'), probe.tell(Odometry, 'ownship')
    probe.meet()
    probe.peer.wait_until_matched(clock, ownship)
    probe.reset()
    begin = probe.stamp
    for _ in range(2):
        for step in range(12):
            probe.stamp = begin + 2.0 * step
            if step in (0, 11):
                clock.publish(Clock(clock=rclpy_types().header(probe.stamp, '').stamp))
                probe.until_diagnosed_at(probe.stamp)
            ownship.publish(odometry(probe.stamp, begin))
            table = probe.answer(beside(probe.stamp, begin))
    assert len(confirmed_ids(table)) == 1
    assert 'refused' not in node.log


def test_stamps_far_from_the_clock_are_told_once_and_tracked(start_node, probe):
    """Who has forgotten use_sim_time reads of it, and has tracks all the same."""
    node = start_node()
    probe.meet()
    probe.confirmed()
    assert 'behind the clock: use_sim_time?' in node.log
    assert node.log.count('use_sim_time?') == 1


def test_fast_clock_costs_little(start_node, probe):
    """One thread: a tick of /clock costs the node under 2 ms, whatever the rate."""
    node = start_node('use_sim_time:=true')
    clock = probe.tell(Clock, '/clock')
    probe.meet()
    probe.peer.wait_until_matched(clock)
    before = cpu_time(node.process.pid)
    now = Clock()
    for tick in range(1000):
        now.clock = rclpy_types().header(probe.stamp + 1e-3 * tick, '').stamp
        clock.publish(now)
        probe.peer.spin(lambda: False, 1e-3)
    probe.until_diagnosed_at(probe.stamp + 0.999)
    assert cpu_time(node.process.pid) - before < 2.0
