# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A node starts with what it can use, and refuses the rest by name."""

from pathlib import Path
import sys

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, SetParameters

from tracking_tools.testing import NodeProcess

ROOT = Path(__file__).parents[2]


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes."""
    return request.getfixturevalue(request.param)


radar_only = pytest.mark.parametrize('sensor', ['radar'], indirect=True)


@radar_only
@pytest.mark.parametrize(
    ('parameter', 'words'),
    [
        ('sensor.range_sd:=-1.0', ['sensor.range_sd', '0.001', '-1.0']),
        ('sensor.range_sd:=wide', ['sensor.range_sd', 'wide']),
        ('association:=hungarian', ['association', 'jpda', 'hungarian']),
        ('sensor.range_min:=1e9', ['sensor.range_min', '1000000000']),
        ('markers.rate:=-2', ['markers.rate', '-2']),
        ('motion.horizontal.sojourn_time:=[1.0, 2.0, 3.0]', ['sojourn_time', '3']),
    ],
)
def test_bad_parameter_is_named_and_ends_the_node(start_node, parameter, words):
    """The node says parameter, limit and value, and exits with 1."""
    node = start_node(parameter)
    assert node.wait() == 1
    assert all(word in node.log for word in words), node.log
    assert 'Traceback' not in node.log


@pytest.mark.parametrize('sensor', ['sonar'], indirect=True)
@pytest.mark.parametrize(
    ('parameter', 'words'),
    [
        ('sensor.bearing_sd:=9.0', ['sensor.bearing_sd', '0.5', '9.0']),
        ('sensor.array:=round', ['sensor.array', 'linear', 'round']),
        ('motion.rate_noise:=[1.0e-6, 1.0e-5]', ['rate_noise', 'one value per mode']),
        ('markers.length:=-2', ['markers.length', '-2']),
    ],
)
def test_bad_parameter_of_the_sonar_is_named_too(start_node, parameter, words):
    """As of the radar."""
    test_bad_parameter_is_named_and_ends_the_node(start_node, parameter, words)


@radar_only
def test_int_is_accepted_for_a_double(start_node, probe):
    """`-p sensor.range_sd:=30` and a list of ints work."""
    node = start_node('sensor.range_sd:=30', 'motion.horizontal.acceleration_sd:=[3, 35]')
    probe.meet()
    assert len(probe.confirmed()['id']) >= 3
    assert '2 parameters come from files or arguments' in node.log


def test_unknown_parameter_is_warned_about_with_the_nearest_name(start_node):
    """A typing error in a parameter's name does not pass in silence."""
    node = start_node('gate.probabilty:=0.9')
    line = node.wait_for_line('gate.probabilty')
    assert 'did you mean gate.probability?' in line


@pytest.mark.parametrize(
    ('value', 'words'),
    [
        ('motion.horizontal.acceleration_sd:=[]', 'acceleration_sd has no value'),
        ('use_sim_time:=1', "'use_sim_time' to '1' of type 'INTEGER', expecting type 'BOOL'"),
        ('qos_overrides./plots.subscription.depth:=-3', 'depth must be in [1, 100000] messages'),
    ],
)
@radar_only
def test_value_that_cannot_be_ends_the_node_with_its_name(start_node, value, words):
    """One line, exit code 1, nothing of the middleware."""
    node = start_node(value)
    assert node.wait() == 1
    assert words in node.log
    assert len(node.log.splitlines()) == 1


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (['-p', 'sensor.range_sd:=1.0'], 'those of ROS come after --ros-args'),
        (['--ros-args', 'plots:=/x'], 'remap with -r FROM:=TO'),
    ],
)
@radar_only
def test_slip_on_the_command_line_ends_the_node(sensor, ros_domain_id, tmp_path, words, said):
    """It would run with other parameters or topics than were meant."""
    command = [sys.executable, '-m', f'{sensor.node}.node', *words]
    with NodeProcess(command, ros_domain_id, tmp_path / 'log', folder=ROOT) as node:
        assert node.wait() == 1
        assert node.log.startswith('cannot start: ')
        assert said in node.log


@radar_only
def test_override_for_a_topic_that_nobody_opens_is_told(start_node):
    """A slip in a topic's name is as one in a parameter's."""
    node = start_node('qos_overrides./plotz.subscription.depth:=9')
    node.wait_for_line('there is no topic for qos_overrides./plotz.subscription.depth')


@radar_only
def test_parameter_file_that_is_not_there_is_named(start_node, tmp_path):
    """As above."""
    path = tmp_path / 'nowhere.yaml'
    node = start_node(arguments=['--params-file', str(path)])
    assert node.wait() == 1
    assert node.log == f'cannot start: there is no parameter file {path}\n'


@radar_only
def test_live_parameter_is_described_checked_and_followed(start_node, probe):
    """A live parameter takes an int, refuses nonsense; a structural one cannot be set."""
    start_node()
    probe.meet()
    request = DescribeParameters.Request(names=['sensor.azimuth_sd', 'association'])
    answer = probe.call(
        DescribeParameters, 'radar_tracker/describe_parameters', request, again=1.0
    )
    number, choice = answer.descriptors
    assert number.description == 'azimuth noise [rad]'
    assert number.floating_point_range[0].from_value == pytest.approx(1e-6)
    assert 'jpda' in choice.additional_constraints

    def set_to(name, value):
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        return probe.call(
            SetParameters, 'radar_tracker/set_parameters', request, again=1.0
        ).results[0]

    whole = ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=5)
    below = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=-1.0)
    word = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value='fast')
    assert set_to('markers.rate', whole).successful
    assert not set_to('markers.rate', below).successful
    refused = set_to('gate.probability', word)
    assert not refused.successful
    assert 'gate.probability' in refused.reason
    assert not set_to('sensor.range_sd', below).successful
    assert len(probe.confirmed()['id']) >= 3
