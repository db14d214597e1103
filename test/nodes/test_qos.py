# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Whoever speaks or listens, reliably or not, is connected, and a silence is explained."""

from geometry_msgs.msg import PoseStamped
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan, PointCloud2

BEST_EFFORT, RELIABLE = ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE
VOLATILE = DurabilityPolicy.VOLATILE
INPUTS = ('/plots', '/ownship', '/acquire', '/cancel')
OUTPUTS = (
    '/radar_tracker/tracks', '/radar_tracker/odometry', '/radar_tracker/markers', '/diagnostics',
)  # fmt: skip


@pytest.fixture
def sensor(request, radar, sonar):
    """Return the radar, or the sonar for tests that say so."""
    return sonar if getattr(request, 'param', '') == 'sonar' else radar


def own_ends(probe, topic):
    """Return (reliability, durability) of the tracker's own ends of a topic."""
    graph, name = probe.node, probe.sensor.node
    ends = [
        *graph.get_publishers_info_by_topic(topic),
        *graph.get_subscriptions_info_by_topic(topic),
    ]
    own = [end.qos_profile for end in ends if end.node_name == name]
    return [(qos.reliability, qos.durability) for qos in own]


@pytest.mark.parametrize('sensor', ['radar', 'sonar'], indirect=True)
def test_best_effort_and_reliable_peers_connect_on_either_side(start_node, probe, sensor):
    """Plots of both kinds of publisher are tracked, both kinds of subscriber hear the tracks."""
    start_node()
    hasty = []
    best_effort = QoSProfile(depth=50, reliability=BEST_EFFORT)
    driver = probe.node.create_publisher(PointCloud2, sensor.topic, best_effort)
    viewer = probe.node.create_subscription(
        PointCloud2, f'{sensor.node}/tracks', hasty.append, best_effort
    )
    probe.meet()
    probe.peer.wait_until_matched(driver, viewer)
    reliable = probe.plots
    for turn in range(6):
        probe.plots = (driver, reliable)[turn % 2]
        probe.scan()  # answers to the reliable subscriber
        probe.spin_until(lambda: hasty[-1:] == probe.tables[-1:], 'the best-effort one')
    probe.plots = reliable


def test_qos_overrides_hold_on_every_topic_and_none_is_transient_local(start_node, probe):
    """A user decides for each topic, by parameter; bags need no late joiners."""
    overrides = [f'qos_overrides.{t}.subscription.reliability:=reliable' for t in INPUTS]
    overrides += [f'qos_overrides.{t}.publisher.reliability:=best_effort' for t in OUTPUTS]
    node = start_node(*overrides)
    probe.spin_until(lambda: all(own_ends(probe, t) for t in (*INPUTS, *OUTPUTS)), 'topics')
    assert {policy for t in INPUTS for policy in own_ends(probe, t)} == {(RELIABLE, VOLATILE)}
    assert {policy for t in OUTPUTS for policy in own_ends(probe, t)} == {(BEST_EFFORT, VOLATILE)}
    assert 'no parameter' not in node.log


def test_silence_is_explained_with_the_publishers_and_their_qos(start_node, probe):
    """A driver that cannot be heard: who it is, and both sides' QoS, in log and diagnostics."""
    node = start_node('qos_overrides./plots.subscription.reliability:=reliable')
    best_effort = QoSProfile(depth=5, reliability=BEST_EFFORT)
    driver = probe.node.create_publisher(PointCloud2, 'plots', best_effort)
    line = node.wait_for_line('nothing has come on /plots')
    assert 'sensor_msgs/msg/PointCloud2, reliable' in line
    assert 'publishers there: ' in line
    assert 'probe (sensor_msgs/msg/PointCloud2, best effort, volatile)' in line
    probe.spin_until(
        lambda: any(
            m.status[0].message in {f'no plots for {s} s' for s in range(5, 30)}
            for m in probe.diagnostics
        ),
        'diagnostics',
    )
    probe.node.destroy_publisher(driver)
    assert node.log.count('nothing has come on') == 1


@pytest.mark.parametrize('sensor', ['sonar'], indirect=True)
def test_silence_without_any_publisher_or_clock_is_explained(start_node, sensor):
    """The node says what it waits for, that nobody is there, and that the clock is missing too."""
    node = start_node('use_sim_time:=true')
    line = node.wait_for_line(f'nothing has come on /{sensor.topic}')
    assert 'sensor_msgs/msg/PointCloud2' in line
    assert 'nobody publishes there' in line
    assert 'use_sim_time is true, but nothing has come on /clock either' in line


@pytest.mark.slow
def test_publishers_that_do_not_fit_are_told_whenever_they_come(start_node, probe):
    """Of every input: own ship of another type leaves the sensor standing still; a late driver."""
    node = start_node(arguments=['-r', 'plots:=points'])
    probe.tell(PoseStamped, 'ownship')
    node.wait_for_line('nobody publishes there')
    own_ship = node.wait_for_line('nothing has come on /ownship')
    assert 'nav_msgs/msg/Odometry' in own_ship
    assert 'publishers there: probe (geometry_msgs/msg/PoseStamped, reliable' in own_ship
    driver = probe.tell(LaserScan, 'points')
    node.wait_for_line('publishers there: probe (sensor_msgs/msg/LaserScan')

    def wait_until_said(what):
        heard = probe.diagnostics
        probe.spin_until(lambda: heard and heard[-1].status[0].message.endswith(what), what)

    wait_until_said('no publisher fits on ownship and plots')
    probe.node.destroy_publisher(driver)
    wait_until_said('no publisher fits on ownship')
    assert node.log.count('nothing has come on') == 3


def test_latency_and_losses_are_in_the_diagnostics(start_node, probe):
    """From arrival to tracks, time of the processor, and messages that the transport has lost."""
    start_node('qos_overrides./plots.subscription.depth:=1')
    probe.meet()
    probe.scan()
    probe.spin_until(lambda: probe.diagnosed('latency [s]') not in (None, 'nan'), 'latency')
    assert 0.0 < float(probe.diagnosed('latency [s]')) < 10.0
    assert 0.0 < float(probe.diagnosed('step CPU [s]')) < 1.0
    noise = {name: np.zeros(5000, np.float32) for name in ('range', 'azimuth')}

    def flood(_):  # faster than anybody reads, unless the sender has to wait for the processor
        for _ in range(200):
            probe.stamp += 0.01
            probe.send(noise, probe.stamp)

    probe.peer.ask(flood, lambda: int(probe.diagnosed('plots lost')) > 0, 'a gap', again=3.0)
    probe.spin_until(
        lambda: any('plots lost' in m.status[0].message for m in probe.diagnostics), 'a warning'
    )
