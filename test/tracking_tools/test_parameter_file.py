# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check how ROS parameter files are read without ROS."""

from pathlib import Path

import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from tracking_session.parameter_blocks import BadParameterFile
from tracking_tools.parameter_file import (
    configure,
    parse_value,
    read_parameter_file,
)
from tracking_tools.sensors import SENSORS

NODE = '/radar_tracker'
CONFIG = Path(__file__).parents[2] / 'config'


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as parameter file of our node."""

    def read(text):
        path = tmp_path / 'some.yaml'
        path.write_text(text)
        return read_parameter_file(path, NODE)

    return read


@pytest.mark.parametrize(
    'key',
    ['/**', 'radar_tracker', '/radar_tracker', '/**/radar_tracker', '/*', '**'],
)
def test_read_parameter_file_uses_blocks_for_the_node(read, key):
    """Wildcards and the name with or without slash are ours."""
    values = read(f"'{key}':\n  ros__parameters:\n    gate: {{probability: 0.9}}\n")
    assert values == {'gate.probability': 0.9}


def test_read_parameter_file_flattens_nested_and_dotted_names(read):
    """Both ways of writing a name mean the same, and may be mixed."""
    text = (
        '/**:\n  ros__parameters:\n    sensor:\n      mount: {x: 1.5}\n      range_sd: 10\n'
        '    gate.probability: 0.5\n    output: map\n'
    )
    assert read(text) == {
        'sensor.mount.x': 1.5, 'sensor.range_sd': 10, 'gate.probability': 0.5, 'output': 'map',
    }  # fmt: skip


def test_read_parameter_file_lets_later_blocks_win(read):
    """The block of the node below that for all overrides it."""
    text = (
        '/**:\n  ros__parameters: {output: map, association: pda}\n'
        'radar_tracker:\n  ros__parameters: {output: mmse}\n'
    )
    assert read(text) == {'output': 'mmse', 'association': 'pda'}


def test_read_parameter_file_knows_namespaces(tmp_path):
    """Nested keys are a namespace; a node in another namespace is another node."""
    path = tmp_path / 'some.yaml'
    path.write_text('ship:\n  radar_tracker:\n    ros__parameters: {output: map}\n')
    assert read_parameter_file(path, '/ship/radar_tracker') == {'output': 'map'}
    with pytest.raises(BadParameterFile, match='are for /ship/radar_tracker, none for'):
        read_parameter_file(path, NODE)


def test_read_parameter_file_notices_another_node(read):
    """A file for somebody else is not silently ignored, as ROS does."""
    with pytest.raises(BadParameterFile, match='are for /radar_trakcer, none for /radar_tracker'):
        read('radar_trakcer:\n  ros__parameters: {output: map}\n')


@pytest.mark.parametrize(
    ('text', 'match'),
    [
        ('output: map\n', "no 'ros__parameters:'"),
        ('- 1\n', 'expected'),
        ('a: [1\n', 'not YAML'),
        ('/**:\n  ros__parameters: {a: [1, 2.5]}\n', 'flat lists of one type'),
        ('/**:\n  ros__parameters: {a: [[1.0], [2.5]]}\n', 'flat lists of one type'),
        ('/**:\n  ros__parameters:\n    output:\n', 'output has no value'),
    ],
)
def test_read_parameter_file_refuses_what_ros_would(read, text, match):
    """What a node could not start with is said here too."""
    with pytest.raises(BadParameterFile, match=match):
        read(text)


def test_read_parameter_file_says_that_there_is_none(tmp_path):
    """The path is in the message."""
    with pytest.raises(BadParameterFile, match=r'none\.yaml cannot be read'):
        read_parameter_file(tmp_path / 'none.yaml', NODE)


def test_parse_value_reads_numbers_as_ros_does():
    """An exponent needs no point, and a list is a list."""
    assert parse_value('1e5') == 1e5
    assert isinstance(parse_value('1e5'), float)
    assert [parse_value(text) for text in ('4.0e4', '-.5e1', '2.E-1')] == [4e4, -5.0, 0.2]
    assert parse_value('[1.0, -2e-3]') == [1.0, -0.002]
    assert parse_value('1e5m') == '1e5m'


def test_configure_gives_each_config_its_own():
    """Values end where their names are known; parameters of ROS itself are left out."""
    tracker, node = configure(
        (RadarTrackerConfig(), radar_node_config()),
        {'sensor.range_sd': 7, 'tracking_frame': 'odom', 'use_sim_time': True},
    )
    assert tracker.sensor.range_sd == 7.0
    assert node.tracking_frame == 'odom'


@pytest.mark.parametrize(
    ('name', 'near'),
    [('gate.probabilty', 'gate.probability'), ('tracking_fame', 'tracking_frame')],
)
def test_configure_names_the_nearest_known_parameter(name, near):
    """A slip of the pen is refused with what was probably meant."""
    with pytest.raises(ValueError, match=f'unknown parameter {name}; did you mean {near}'):
        configure((RadarTrackerConfig(), radar_node_config()), {name: 1})


@pytest.mark.parametrize('name', ['sensor.bearing_sd', 'initiation.rate_max', 'sensor.array'])
def test_parameter_of_another_sensor_has_no_near_one(name):
    """What is only alike is no hint: bearing_sd is not a slip of range_sd, but the sonar's."""
    said = f'unknown parameter {name}; the sonar tracker has {name}: is the parameter file meant'
    with pytest.raises(ValueError, match=said):
        configure((RadarTrackerConfig(), radar_node_config()), {name: 1})


def test_name_without_its_group_is_completed():
    """As users write it first."""
    with pytest.raises(ValueError, match=r'did you mean sensor\.range_max'):
        configure((RadarTrackerConfig(), radar_node_config()), {'range_max': 1})


@pytest.mark.parametrize('file', sorted(CONFIG.glob('*.yaml')), ids=lambda path: path.stem)
def test_shipped_parameter_files_configure_the_node(file):
    """Every shipped file is for any node name and has known names and allowed values."""
    values = read_parameter_file(file, '/any/name')
    assert values
    sensor = 'sonar' if 'sensor.bearing_sd' in values else 'radar'
    configure(SENSORS[sensor].configs, values)


BOMB = 'a: &a [1]\n' + ''.join(
    f'{new}: &{new} [{", ".join([f"*{old}"] * 10)}]\n'
    for old, new in zip('abcdefgh', 'bcdefghi', strict=True)
)


@pytest.mark.parametrize(
    'text',
    ['[' * 50_000, BOMB, '/**: &a\n  x: *a\n', 'a: 2001-99-99\n', 'a: !!python/name:os.system\n',
     '#' * 1_000_001],
    ids=['deep', 'bomb', 'circle', 'no date', 'object', 'long'],
)  # fmt: skip
def test_read_parameter_file_refuses_hostile_yaml(read, text):
    """What would recurse, grow or build objects is refused with the name of the file."""
    with pytest.raises(BadParameterFile, match=r'some\.yaml'):
        read(text)
