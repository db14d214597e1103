# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Load the launch files and compare what they start with what setup.py installs.

The launch packages have no wheels, so the files are loaded against the few classes below. Their
signatures are those of Jazzy, so that an unknown or misspelt argument is refused here too.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, is_dataclass
from pathlib import Path
import re
import runpy
import sys
from types import ModuleType
from typing import Any

import pytest

from tracking_tools.testing import NodeProcess, python_node

ROOT = Path(__file__).parent.parent
LAUNCH_FILES = sorted((ROOT / 'launch').glob('*.launch.py'))
COMMON_ARGUMENTS = {'namespace', 'use_sim_time', 'autostart', 'log_level'}


@dataclass(frozen=True)
class LaunchDescription:
    """All that a launch file starts and declares."""

    entities: list[Any]


@dataclass(frozen=True)
class DeclareLaunchArgument:
    """One argument of a launch file."""

    name: str
    default_value: Any = field(default=None, kw_only=True)
    description: str = field(default='', kw_only=True)


@dataclass(frozen=True)
class LaunchConfiguration:
    """The value of an argument."""

    variable_name: str


@dataclass(frozen=True)
class PathJoinSubstitution:
    """A path that is put together when the file is launched."""

    substitutions: list[Any]


@dataclass(frozen=True)
class FindPackageShare:
    """The share folder of a package."""

    package: str


@dataclass(frozen=True)
class ParameterValue:
    """A parameter with a type of its own."""

    value: Any
    value_type: type = field(kw_only=True)


@dataclass(frozen=True)
class IfCondition:
    """Whether something is done."""

    predicate_expression: Any


@dataclass(frozen=True)
class Shutdown:
    """The end of everything that was launched."""

    reason: str = field(kw_only=True)


@dataclass(frozen=True, kw_only=True)
class ExecuteProcess:
    """Any program."""

    cmd: list[Any]
    output: str
    condition: IfCondition | None = None
    on_exit: Any = None


@dataclass(frozen=True, kw_only=True)
class Node:
    """A node in a process of its own."""

    package: str
    executable: Any
    name: Any
    namespace: Any = ''
    output: str
    parameters: list[Any]
    remappings: list[tuple[str, Any]] = field(default_factory=list)
    arguments: list[Any]
    condition: IfCondition | None = None


STAND_IN = {
    'launch': (LaunchDescription,),
    'launch.actions': (DeclareLaunchArgument, ExecuteProcess, Shutdown),
    'launch.conditions': (IfCondition,),
    'launch.substitutions': (LaunchConfiguration, PathJoinSubstitution),
    'launch_ros': (),
    'launch_ros.actions': (Node,),
    'launch_ros.parameter_descriptions': (ParameterValue,),
    'launch_ros.substitutions': (FindPackageShare,),
}


@pytest.fixture(params=LAUNCH_FILES, ids=lambda path: path.name)
def entities(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Load one launch file and list what it describes."""
    return _load(request.param, monkeypatch)


def _load(path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    for name, classes in STAND_IN.items():
        module = ModuleType(name)
        for each in classes:
            setattr(module, each.__name__, each)
        monkeypatch.setitem(sys.modules, name, module)
    description = runpy.run_path(str(path))['generate_launch_description']()
    assert isinstance(description, LaunchDescription)
    return description.entities


def _only(kind: type, entities: list[Any]) -> list[Any]:
    return [entity for entity in entities if isinstance(entity, kind)]


def _trackers(entities: list[Any]) -> list[Any]:
    return [node for node in _only(Node, entities) if node.package == 'contact_tracking']


def _text(value: Any, given: dict[str, Any]) -> str:
    """Put a substitution together, with these values of the arguments."""
    if isinstance(value, LaunchConfiguration):
        return _text(given[value.variable_name], given)
    if isinstance(value, PathJoinSubstitution):
        return '/'.join(_text(part, given) for part in value.substitutions)
    if isinstance(value, FindPackageShare):
        return f'share/{value.package}'
    return value if isinstance(value, str) else ''.join(_text(part, given) for part in value)


def _values(entities: list[Any], **given: str) -> dict[str, Any]:
    """Return the values of all arguments, defaults where none is given."""
    declared = _only(DeclareLaunchArgument, entities)
    return {argument.name: argument.default_value for argument in declared} | given


def _parts(value: Any) -> Iterator[Any]:
    """Walk through a value and everything that it holds."""
    yield value
    if isinstance(value, dict):
        value = list(value.values())
    elif is_dataclass(value) and not isinstance(value, type):
        value = [getattr(value, each.name) for each in fields(value)]
    if isinstance(value, (list, tuple)):
        for each in value:
            yield from _parts(each)


def test_there_are_launch_files() -> None:
    """The tests below run on at least one file."""
    assert LAUNCH_FILES


@pytest.mark.parametrize('sensor', ['radar', 'sonar'])
def test_node_is_an_installed_command(
    entities: list[Any], setup_arguments: dict[str, Any], sensor: str
) -> None:
    """Package and executable are names that ros2 launch can find."""
    scripts = setup_arguments['entry_points']['console_scripts']
    commands = {re.split(' *=', script)[0] for script in scripts}
    nodes = _trackers(entities)
    assert nodes
    given = _values(entities, sensor=sensor)
    assert {_text(node.executable, given) for node in nodes} <= commands
    assert all(_text(node.name, given) == _text(node.executable, given) for node in nodes)


def test_arguments_are_declared_and_used(entities: list[Any]) -> None:
    """Every argument has a default and a description, and reaches the node."""
    declared = _only(DeclareLaunchArgument, entities)
    used = {part.variable_name for part in _only(LaunchConfiguration, list(_parts(entities)))}
    assert {argument.name for argument in declared} == used
    assert used >= COMMON_ARGUMENTS
    assert sum(name.endswith('params_file') for name in used) == len(_trackers(entities))
    assert all(argument.description for argument in declared)
    assert all(argument.default_value is not None for argument in declared)


def test_topics_keep_their_names_by_default(entities: list[Any]) -> None:
    """A remapping changes nothing until its argument is given; those of a bag are absolute."""
    given = _values(entities)
    for node in _trackers(entities):
        assert {topic for topic, _ in node.remappings} >= {'ownship'}
        assert all(_text(new, given).lstrip('/') == topic for topic, new in node.remappings)


@pytest.mark.parametrize('sensor', ['radar', 'sonar'])
def test_default_files_are_shipped(
    entities: list[Any], setup_arguments: dict[str, Any], sensor: str
) -> None:
    """Parameter file and RViz configuration are those that setup.py installs."""
    given = _values(entities, sensor=sensor)
    for name in (name for name in given if name.endswith(('params_file', 'rviz_config'))):
        folder, _, file = _text(given[name], given).rpartition('/')
        shipped = dict(setup_arguments['data_files'])[folder]
        assert file in {Path(path).name for path in shipped}


@pytest.mark.parametrize('sensor', ['radar', 'sonar', 'replay'])
def test_preset_is_a_name_without_a_path(sensor: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file is found wherever the package is installed; one of the user's goes before it."""
    entities = _load(ROOT / 'launch' / f'{sensor}.launch.py', monkeypatch)
    given = _values(entities, preset='marine_radar.yaml')
    assert _text(given['params_file'], given) == 'share/contact_tracking/config/marine_radar.yaml'
    (node,) = _trackers(entities)
    given = _values(entities, preset='marine_radar.yaml', params_file='/my/radar.yaml')
    assert '/my/radar.yaml' in [_text(word, given) for word in node.arguments]


def test_parameter_file_that_is_not_there_reaches_the_node(
    entities: list[Any], ros_domain_id: int, tmp_path: Path
) -> None:
    """The node says so; launch would leave it out of the parameters with a warning."""
    slips = {name: 'slip' for name in _values(entities) if name.endswith('params_file')}
    given, node = _values(entities, sensor='radar', **slips), _trackers(entities)[-1]
    words = [_text(word, given) for word in (node.executable, *node.arguments)]
    command = python_node(f'{words[0]}.node')[:-1] + words[1:]
    with NodeProcess(command, ros_domain_id, tmp_path / 'log', folder=ROOT) as process:
        assert (process.wait(), 'there is no parameter file slip' in process.log) == (1, True)


def test_switches_arrive_as_booleans(entities: list[Any]) -> None:
    """Launch arguments are text; the node declares these two as booleans."""
    for node in _trackers(entities):
        values = {
            name: each for part in _only(dict, node.parameters) for name, each in part.items()
        }
        assert values == {
            name: ParameterValue(LaunchConfiguration(name), value_type=bool)
            for name in ('use_sim_time', 'autostart')
        }


def test_replay_plays_and_records_until_the_bag_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """The player has the clock and ends everything; all tracks are the node's, none the bag's."""
    entities = _load(ROOT / 'launch' / 'replay.launch.py', monkeypatch)
    given = _values(entities, sensor='sonar', bag='/data/patrol', output='/tmp/out', rate='4')
    record, play = (
        [_text(word, given) for word in process.cmd] for process in _only(ExecuteProcess, entities)
    )
    assert play[:5] == ['ros2', 'bag', 'play', '/data/patrol', '--clock']
    assert play[play.index('--rate') + 1] == '4'
    assert record[record.index('--output') + 1] == '/tmp/out'
    for words, option in ((record, '--regex'), (play, '-x')):
        wanted = re.compile(words[words.index(option) + 1])
        assert wanted.fullmatch('/boat/sonar_tracker/tracks')
        assert not wanted.fullmatch('/radar_tracker/tracks')
    ends = [process.on_exit for process in _only(ExecuteProcess, entities)]
    assert ends == [None, Shutdown(reason='the bag is over')]


def test_replay_starts_rviz_only_when_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine without a display replays too."""
    entities = _load(ROOT / 'launch' / 'replay.launch.py', monkeypatch)
    (viewer,) = (node for node in _only(Node, entities) if node.package == 'rviz2')
    assert viewer.condition == IfCondition(LaunchConfiguration('rviz'))
    assert _values(entities)['rviz'] == 'false'


def test_three_sensors_share_no_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every node and every topic of theirs is in its own namespace; own ship is for all."""
    entities = _load(ROOT / 'launch' / 'three_sensors.launch.py', monkeypatch)
    for given in (_values(entities), _values(entities, namespace='/ship')):
        places = [_text(node.namespace, given) for node in _trackers(entities)]
        assert len(set(places)) == 3
        assert all(place.startswith(f'{given["namespace"]}/') for place in places)
        topics = [
            {_text(new, given) for _, new in node.remappings} for node in _trackers(entities)
        ]
        assert [{name for name in each if name[0] == '/'} for each in topics] == [{'/ownship'}] * 3
