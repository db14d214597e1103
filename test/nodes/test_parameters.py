# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of running nodes: presets, files for others, changes that are all right or none."""

from contextlib import ExitStack
from pathlib import Path

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters, SetParametersAtomically
from rclpy.parameter import parameter_value_to_python
import yaml

from tracking_core.config import parameters, with_values
from tracking_node.parameters import describe
from tracking_tools.parameter_file import configure, read_parameter_file
from tracking_tools.sensors import SENSORS
from tracking_tools.testing import NodeProcess, Peer, python_node, RADAR

ROOT = Path(__file__).parents[2]
PRESETS = sorted((ROOT / 'config').glob('*.yaml'))
GROUPS = [PRESETS[start : start + 4] for start in range(0, len(PRESETS), 4)]
WANTED = {
    'air_surveillance_3d', 'air_surveillance_2d', 'terminal_radar', 'marine_radar',
    'fast_small_craft_radar', 'passive_linear_array', 'direction_finder', 'drone_radar',
    'surface_movement_radar', 'short_range_radar',
}  # fmt: skip


@pytest.fixture
def sensor(request, radar, sonar):
    """Return the radar, or the sonar for tests that say so."""
    return sonar if getattr(request, 'param', '') == 'sonar' else radar


def double(name, value):
    """Return a parameter to set."""
    kind = ParameterType.PARAMETER_DOUBLE
    return Parameter(name=name, value=ParameterValue(type=kind, double_value=value))


def set_together(probe, *changes):
    """Ask for all changes or none; return the result."""
    request = SetParametersAtomically.Request(parameters=list(changes))
    name = f'{probe.sensor.node}/set_parameters_atomically'
    return probe.call(SetParametersAtomically, name, request, again=1.0).result


def get(probe, *names):
    """Return the values of parameters."""
    request = GetParameters.Request(names=list(names))
    answer = probe.call(GetParameters, f'{probe.sensor.node}/get_parameters', request, again=1.0)
    return [value.double_value for value in answer.values]


def node_of(path):
    """Return the node whose parameters a preset has."""
    given = set(read_parameter_file(path, '/any'))
    for sensor in SENSORS.values():
        if given <= {entry.name for config in sensor.configs for entry in parameters(config)}:
            return sensor.node
    raise AssertionError(f'{path} is for no node')


@pytest.mark.parametrize('presets', GROUPS, ids=lambda group: '-'.join(p.stem for p in group))
def test_presets_load_in_a_node(presets, ros_domain_id, tmp_path):
    """Every shipped file makes a node active, all its values are used, and nothing is odd."""
    with ExitStack() as running:
        peer = running.enter_context(Peer(ros_domain_id))
        nodes = {}
        for path in presets:
            module = f'{node_of(path)}.node'
            command = python_node(module, '--params-file', str(path), '-r', f'__node:={path.stem}')
            node = NodeProcess(command, ros_domain_id, tmp_path / path.stem, folder=ROOT)
            nodes[path.stem] = running.enter_context(node)
        for name, node in nodes.items():
            peer.wait_until_active(name)
            node.wait_for_line('parameters come from files or arguments')
            assert 'WARN' not in node.log, node.log


def test_wanted_presets_are_shipped():
    """Air, terminal, sea, small craft, drones, airport, short range, array, direction finder."""
    assert {path.stem for path in PRESETS} >= WANTED


@pytest.mark.parametrize('kind', SENSORS)
def test_every_parameter_has_meaning_unit_and_range(kind):
    """Numbers have all three; switches and names a meaning."""
    for config in SENSORS[kind].configs:
        for entry in parameters(config):
            assert entry.doc
            first = entry.value[0] if isinstance(entry.value, tuple) else entry.value
            if isinstance(first, (int, float)) and not isinstance(first, bool):
                assert entry.unit, entry.name
                assert entry.low is not None or entry.high is not None, entry.name
                told = describe(entry)
                assert 'None' not in told.additional_constraints
                for each in (*told.floating_point_range, *told.integer_range):
                    with pytest.raises(ValueError, match=entry.name):
                        with_values(config, {entry.name: each.to_value * 2 + 1})


def test_parameter_files_are_told_apart(start_node, tmp_path):
    """One for another node and one with a typing error are noticed, an int for a double is not."""
    foreign, own = tmp_path / 'foreign.yaml', tmp_path / 'own.yaml'
    foreign.write_text('radar_traker:\n  ros__parameters: {gate.probability: 0.9}\n')
    own.write_text('/**:\n  ros__parameters: {sensor: {range_sd: 30, azimut_sd: 0.002}}\n')
    node = start_node(arguments=['--params-file', str(foreign), '--params-file', str(own)])
    assert '1 parameters come from' in node.wait_for_line('parameters come from')
    assert 'did you mean sensor.azimuth_sd?' in node.wait_for_line('sensor.azimut_sd')
    line = node.wait_for_line('no parameters from')
    assert 'foreign.yaml' in line
    assert 'are for /radar_traker, none for /radar_tracker' in line


@pytest.mark.parametrize('sensor', ['radar', 'sonar'], indirect=True)
def test_dump_of_a_node_is_a_file_for_it_and_for_a_replay(start_node, probe, sensor, tmp_path):
    """All that `ros2 param dump` writes may be given again, without a word."""
    first, name = start_node(), sensor.node
    probe.peer.wait_until_active(name)
    listing = probe.call(ListParameters, f'{name}/list_parameters', ListParameters.Request())
    names = listing.result.names
    request = GetParameters.Request(names=names)
    values = probe.call(GetParameters, f'{name}/get_parameters', request, again=1.0).values
    dump = dict(zip(names, map(parameter_value_to_python, values), strict=True))
    file = tmp_path / 'dump.yaml'
    file.write_text(yaml.dump({f'/{name}': {'ros__parameters': dump}}))
    first.stop()
    node = start_node(arguments=['--params-file', str(file)])
    line = node.wait_for_line('parameters come from')
    assert f'{len(names)} parameters' in line
    probe.peer.wait_until_active(name)
    assert 'WARN' not in node.log
    kind = SENSORS['radar' if name == RADAR.node else 'sonar']
    assert configure(kind.configs, read_parameter_file(file, f'/{name}')) == kind.configs


def test_parameter_file_of_the_other_sensor_is_told(start_node):
    """A value that only the sonar has ends the radar node, and its names are said to be its."""
    node = start_node(arguments=['--params-file', str(ROOT / 'config/direction_finder.yaml')])
    line = node.wait_for_line('estimator must be one of')
    assert 'the sonar tracker has sensor.array: is the parameter file meant for it?' in line
    node = start_node('ranging.enabled:=false')
    assert 'the sonar tracker has ranging.enabled' in node.wait_for_line('there is no parameter')


@pytest.mark.parametrize('sensor', ['radar', 'sonar'], indirect=True)
def test_live_change_holds_from_the_next_scan_on(start_node, probe):
    """A wider gate is in the table of the very next scan; the tracks are kept."""
    start_node('gate.probability:=0.9')
    probe.meet()
    before = probe.confirmed()
    assert set_together(probe, double('gate.probability', 0.999)).successful
    after = probe.scan()
    rows = after['hits'] > 0
    assert after['gate_threshold'][rows].min() > before['gate_threshold'].max()
    assert set(after['id']) >= set(before['id'][before['status'] == 1])


def test_bad_change_among_good_ones_changes_nothing(start_node, probe):
    """All or nothing, and the reason names the bad one and its limit."""
    start_node()
    probe.meet()
    names = ['gate.probability', 'existence.confirm', 'clutter_density', 'sensor.range_max']
    before = get(probe, *names)
    good = [double('gate.probability', 0.95), double('existence.confirm', 0.9)]
    for bad, words in (
        (double('clutter_density', -1.0), ['clutter_density', '0', '-1.0']),
        (double('existence.drop', float('nan')), ['existence.drop', 'nan']),
        (double('sensor.range_max', 1e3), ['sensor.range_max', 'read-only']),
        (double('gate.probabilty', 0.9), ['undeclared']),  # in rclpy's own words
    ):
        result = set_together(probe, good[0], bad, good[1])
        assert not result.successful
        assert all(word in result.reason for word in words), result.reason
        assert get(probe, *names) == before
    assert set_together(probe, *good).successful
    assert get(probe, *names) == [0.95, 0.9, *before[2:]]
