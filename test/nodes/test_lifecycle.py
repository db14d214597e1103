# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Both nodes as a lifecycle manager sees them: every transition, also wrong and failing ones."""

from pathlib import Path
import re
import sys

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav_msgs.msg import Odometry
import pytest
from visualization_msgs.msg import Marker, MarkerArray

from tracking_tools.testing import confirmed_ids, NodeProcess

ROOT = Path(__file__).parents[2]
CYCLE = [
    Transition.TRANSITION_CONFIGURE,
    Transition.TRANSITION_ACTIVATE,
    Transition.TRANSITION_DEACTIVATE,
    Transition.TRANSITION_CLEANUP,
]
FAULTY = """
import sys
from tracking_node.tracker_node import TrackerNode
from tracking_node.run import run
from {node} import live, session

tries = iter([1])

def broken_once(*arguments):
    if next(tries, None):
        raise KeyError('a fault nobody thought of')
    return session.{sensor}_session(*arguments)

def make_node():
    node = live.make_node()
    node._make_session = broken_once
    return node

sys.exit(run(make_node))
"""


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes, or the one that a test asks for."""
    return request.getfixturevalue(request.param)


radar_only = pytest.mark.parametrize('sensor', ['radar'], indirect=True)  # what both share


def topics_of(probe):
    """Return the topics that the tracker takes part in, but those of every ROS node."""
    node, graph = probe.sensor.node, probe.node
    probe.peer.wait_for_node(f'/{node}')
    there = [
        *graph.get_subscriber_names_and_types_by_node(node, '/'),
        *graph.get_publisher_names_and_types_by_node(node, '/'),
    ]
    of_ros = {'/rosout', '/parameter_events', f'/{node}/transition_event'}
    return {name for name, _ in there} - of_ros


def test_lifecycle_steps_from_autostart_false_to_shutdown(start_node, probe, sensor):
    """Without autostart a manager leads; every step answers, and opens or closes the topics."""
    node = start_node('autostart:=false')
    assert probe.peer.state(sensor.node) == 'unconfigured'
    node.wait_for_line('autostart is false')
    assert topics_of(probe) == set()
    for _ in range(2):
        assert probe.peer.change_state(sensor.node, 'configure')
        assert probe.peer.change_state(sensor.node, 'activate')
        probe.meet()
        assert probe.confirmed()['hits'].max() <= 13  # nothing is left of the cycle before
        assert probe.peer.change_state(sensor.node, 'deactivate')
        assert probe.peer.change_state(sensor.node, 'cleanup')
        probe.spin_until(lambda: not topics_of(probe), 'closed topics')
    assert probe.peer.change_state(sensor.node, 'unconfigured_shutdown')
    assert probe.peer.state(sensor.node) == 'finalized'
    node.signal(2)
    assert node.wait() == 0


def erases(msg):
    """Return whether these are markers that clear the screen."""
    return any(marker.action == Marker.DELETEALL for marker in getattr(msg, 'markers', []))


def test_tracks_are_kept_while_inactive_and_publishers_silent(start_node, probe, sensor):
    """What comes meanwhile is ignored, which is told, not lost; the same tracks go on then."""
    node = start_node('markers.rate:=100.0')
    others = []
    ends = [
        probe.hear(Odometry, f'{sensor.node}/odometry', others),
        probe.hear(MarkerArray, f'{sensor.node}/markers', others),
    ]
    probe.meet()
    probe.peer.wait_until_matched(*ends)
    before = confirmed_ids(probe.confirmed())
    probe.spin_until(lambda: others, 'markers')
    assert probe.peer.change_state(sensor.node, 'deactivate')
    probe.spin_until(
        lambda: 'not active' in {msg.status[0].message for msg in probe.diagnostics}, 'diagnostics'
    )
    probe.spin_until(lambda: any(map(erases, others)), 'erased markers')  # the last of all
    heard = len(probe.tables), len(others)
    for _ in range(2):
        probe.stamp += probe.sensor.period
        probe.send(probe.sensor.contacts(probe.stamp), probe.stamp)
    assert probe.peer.state(sensor.node) == 'inactive'  # answered after the plots
    node.wait_for_line(f'{sensor.topic} come, but the node is not active')
    assert (len(probe.tables), len(others)) == heard
    assert probe.peer.change_state(sensor.node, 'activate')
    assert confirmed_ids(probe.scan()) >= before
    assert len(probe.tables) == heard[0] + 1
    probe.diagnostics.clear()
    probe.spin_until(lambda: probe.diagnostics, 'diagnostics')
    assert probe.diagnosed(f'{sensor.topic} lost') == '0'


@radar_only
@pytest.mark.parametrize('step', ['deactivate', 'active_shutdown'])
def test_last_diagnostics_of_a_node_say_that_it_is_not_active(start_node, probe, sensor, step):
    """Whoever looks later must not read that it tracks; nor must one wait for a second."""
    start_node()
    probe.meet()
    assert probe.peer.change_state(sensor.node, step)
    probe.spin_until(
        lambda: probe.diagnostics[-1].status[0].message == 'not active', 'diagnostics', 5.0
    )


@radar_only
def test_wrong_transition_is_refused_and_changes_nothing(start_node, probe, sensor):
    """A manager that errs does not end the node, as it would with rclpy alone."""
    node = start_node()
    probe.meet()
    assert not probe.peer.change_state(sensor.node, 'activate')
    node.wait_for_line(f'active: there is no transition {Transition.TRANSITION_ACTIVATE}')
    assert not probe.peer.change_state(sensor.node, 'cleanup')
    assert probe.peer.state(sensor.node) == 'active'
    probe.scan()


@radar_only
def test_step_that_fails_is_told_and_leaves_nothing_open(start_node, probe, sensor):
    """What cannot be used, mount and tf2, is seen after the topics: they are closed again."""
    node = start_node(
        'autostart:=false', 'use_tf:=true', 'tracking_frame:=odom', 'sensor.mount.x:=3.0'
    )
    for _ in range(2):
        assert not probe.peer.change_state(sensor.node, 'configure')
        assert probe.peer.state(sensor.node) == 'unconfigured'
    probe.spin_until(lambda: not topics_of(probe), 'closed topics')
    assert 'use_tf is true' in node.wait_for_line('cannot be configured')


@radar_only
def test_fault_in_a_step_is_shown_and_the_node_can_try_again(probe, sensor, tmp_path):
    """Error processing: rclpy says nothing of the exception, we do; then all is as before."""
    program = FAULTY.format(node=sensor.node, sensor=sensor.frame)
    command = [sys.executable, '-c', program, '--ros-args', '-p', 'autostart:=false']
    with NodeProcess(command, probe.domain_id, tmp_path / 'log', folder=ROOT) as node:
        assert not probe.peer.change_state(sensor.node, 'configure')
        node.wait_for_line('a fault nobody thought of')
        assert probe.peer.state(sensor.node) == 'unconfigured'
        assert probe.peer.change_state(sensor.node, 'configure')
        assert probe.peer.change_state(sensor.node, 'activate')
        probe.meet()
    assert node.exit_code == 0


def resident(pid):
    """Return the memory of a process [kB]."""
    return int(re.search(r'VmRSS:\s*(\d+)', Path(f'/proc/{pid}/status').read_text()).group(1))


def growth_over(cycles, node, probe, sensor):
    """Return how much memory grows [kB] over lifecycle cycles, after half as many before."""
    client = probe.node.create_client(ChangeState, f'{sensor.node}/change_state')
    probe.spin_until(client.service_is_ready)
    before = 0
    for cycle in range(cycles + cycles // 2):
        if cycle == cycles // 2:
            before = resident(node.process.pid)
        for number in CYCLE:
            request = ChangeState.Request(transition=Transition(id=number))
            future = client.call_async(request)
            probe.spin_until(future.done, 'a step')
            assert future.result().success
    return resident(node.process.pid) - before


def test_lifecycle_cycles_leave_no_memory_behind(start_node, probe, sensor):
    """Twenty; topics that stayed open would hold 650 kB a cycle."""
    growth = growth_over(20, start_node('autostart:=false'), probe, sensor)
    assert growth < 20 * 200


@pytest.mark.soak
def test_a_hundred_lifecycle_cycles_leave_no_memory_behind(start_node, probe, sensor):
    """The same with a tighter bound, 10 kB a cycle, when all that is kept has been filled."""
    growth = growth_over(100, start_node('autostart:=false'), probe, sensor)
    print(f'{sensor.node}: {growth} kB more after 100 lifecycle cycles')
    assert growth < 1000
