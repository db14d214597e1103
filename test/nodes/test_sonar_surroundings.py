# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The sonar node on a ship that moves and whose odometry stops, and what a viewer sees."""

from nav_msgs.msg import Odometry
import numpy as np
import pytest
from visualization_msgs.msg import MarkerArray

from msg_adapters.message_types import rclpy_types

PARAMETERS = ('sensor.bearing_sd:=0.004', 'initiation.rate_sd:=0.0005')
DEGREE = np.pi / 180.0
SPEED = 5.0  # of own ship [m/s]


@pytest.fixture
def sensor(sonar):
    """Test the sonar."""
    return sonar


def confirmed(table):
    """Return the ids of the confirmed tracks."""
    return set(table['id'][table['status'] == 1].tolist())


def odometry(stamp, since):
    """Return own ship, which heads north."""
    msg = Odometry(header=rclpy_types().header(stamp, 'odom'), child_frame_id='base_link')
    msg.pose.pose.position.y = SPEED * (stamp - since)
    msg.pose.pose.orientation.z = msg.pose.pose.orientation.w = float(np.sqrt(0.5))
    msg.twist.twist.linear.x = SPEED
    return msg


def test_tracks_live_through_a_gap_of_own_ship(start_node, probe):
    """Bearings turn with the ship; without its odometry cycles wait outside, then all goes on."""
    node = start_node(
        *PARAMETERS,
        'ownship_timeout:=5.0',
        'qos_overrides./ownship.subscription.reliability:=reliable',
    )
    ownship = probe.node.create_publisher(Odometry, 'ownship', 50)
    probe.meet()
    probe.spin_until(ownship.get_subscription_count)
    since = probe.stamp
    for before in (0.2, 0.1, 0.0):  # one alone is not believed
        ownship.publish(odometry(since - before, since))
    node.wait_for_line("the tracking frame is 'odom'")

    def cycle():
        probe.stamp += 2.0
        ownship.publish(odometry(probe.stamp, since))
        return probe.answer(probe.sensor.contacts(probe.stamp))

    for _ in range(12):
        table = cycle()
    before = confirmed(table)
    assert len(before) == 20
    probe.stamp += 6.0
    for _ in range(3):
        probe.stamp += 2.0
        probe.send(probe.sensor.contacts(probe.stamp), probe.stamp)
    probe.spin_until(lambda: probe.diagnosed('bearings refused: own ship stale') == '3')
    assert confirmed(cycle()) == before
    assert probe.tables[-1].header.frame_id == 'odom'
    true = probe.sensor.contacts(probe.stamp)['bearing'] + 0.5 * np.pi  # ahead is north
    table = cycle()
    apart = np.angle(np.exp(1j * (table['bearing'][:, None] - true)))
    assert np.abs(apart).min(axis=1).max() < 1.0 * DEGREE


@pytest.mark.parametrize('array', ['linear', 'omnidirectional'])
def test_fans_show_what_an_array_cannot_tell(start_node, probe, array):
    """Every track has a fan; that of a linear array has a fainter one on the other side."""
    start_node(*PARAMETERS, 'markers.rate:=100.0', f'sensor.array:={array}')
    drawings = []
    end = probe.hear(MarkerArray, 'sonar_tracker/markers', drawings)
    probe.meet()
    probe.spin_until(end.get_publisher_count)
    probe.confirmed()
    spaces = {'fan', 'gate', 'id'} | ({'mirror'} if array == 'linear' else set())

    def drawn():
        return [m for m in drawings[-1].markers if m.action == 0] if drawings else []

    probe.spin_until(lambda: spaces == {m.ns for m in drawn()})
    fan = next(m for m in drawn() if m.ns == 'fan')
    assert fan.scale.x == pytest.approx(10_000.0)
    assert 0.0 < fan.scale.y < 300.0
    if array == 'linear':
        other = next(m for m in drawn() if (m.ns, m.id) == ('mirror', fan.id))
        assert other.colors[0].a < fan.colors[0].a
        assert other.pose.orientation.z == pytest.approx(-fan.pose.orientation.z)
