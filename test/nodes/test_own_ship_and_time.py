# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The radar node on a platform that moves, and under simulated time that goes back."""

from nav_msgs.msg import Odometry
import numpy as np
from rosgraph_msgs.msg import Clock

from msg_adapters.message_types import rclpy_types

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


def test_plots_of_a_moving_sensor_are_tracked_in_the_frame_of_its_odometry(start_node, probe):
    """A buoy lies still in the tracking frame, whatever the ship does."""
    node = start_node(
        'ownship_timeout:=5.0',
        'qos_overrides./ownship.subscription.reliability:=reliable',
        'sensor.azimuth_sd:=0.001',
    )
    ownship = probe.node.create_publisher(Odometry, 'ownship', 50)
    probe.meet()
    probe.spin_until(ownship.get_subscription_count)
    since = probe.stamp
    ownship.publish(odometry(probe.stamp, since))
    node.wait_for_line("the tracking frame is 'odom'")
    for _ in range(12):
        probe.stamp += 2.0
        ownship.publish(odometry(probe.stamp, since))
        table = probe.answer(beside(probe.stamp, since))
    assert probe.tables[-1].header.frame_id == 'odom'
    (row,) = np.flatnonzero(table['status'] == 1)
    assert np.hypot(table['x'][row] - 5000.0, table['y'][row] - 1000.0) < 100.0
    assert table['speed'][row] < 5.0


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
