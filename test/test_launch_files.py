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

ROOT = Path(__file__).parent.parent
LAUNCH_FILES = sorted((ROOT / 'launch').glob('*.launch.py'))
COMMON_ARGUMENTS = {'params_file', 'namespace', 'use_sim_time', 'autostart', 'log_level'}


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


@dataclass(frozen=True, kw_only=True)
class Node:
    """A node in a process of its own."""

    package: str
    executable: str
    name: str
    namespace: Any
    output: str
    parameters: list[Any]
    remappings: list[tuple[str, Any]]
    arguments: list[Any]


STAND_IN = {
    'launch': (LaunchDescription,),
    'launch.actions': (DeclareLaunchArgument,),
    'launch.substitutions': (LaunchConfiguration, PathJoinSubstitution),
    'launch_ros': (),
    'launch_ros.actions': (Node,),
    'launch_ros.parameter_descriptions': (ParameterValue,),
    'launch_ros.substitutions': (FindPackageShare,),
}


@pytest.fixture(params=LAUNCH_FILES, ids=lambda path: path.name)
def entities(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Load one launch file and list what it describes."""
    for name, classes in STAND_IN.items():
        module = ModuleType(name)
        for each in classes:
            setattr(module, each.__name__, each)
        monkeypatch.setitem(sys.modules, name, module)
    description = runpy.run_path(str(request.param))['generate_launch_description']()
    assert isinstance(description, LaunchDescription)
    return description.entities


def _only(kind: type, entities: list[Any]) -> list[Any]:
    return [entity for entity in entities if isinstance(entity, kind)]


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


def test_node_is_an_installed_command(
    entities: list[Any], setup_arguments: dict[str, Any]
) -> None:
    """Package and executable are names that ros2 launch can find."""
    scripts = setup_arguments['entry_points']['console_scripts']
    commands = {re.split(' *=', script)[0] for script in scripts}
    nodes = _only(Node, entities)
    assert nodes
    assert {node.package for node in nodes} == {setup_arguments['name']}
    assert {node.executable for node in nodes} <= commands


def test_arguments_are_declared_and_used(entities: list[Any]) -> None:
    """Every argument has a default and a description, and reaches the node."""
    declared = _only(DeclareLaunchArgument, entities)
    used = {part.variable_name for part in _only(LaunchConfiguration, list(_parts(entities)))}
    assert {argument.name for argument in declared} == used
    assert used >= COMMON_ARGUMENTS
    assert all(argument.description for argument in declared)
    assert all(argument.default_value is not None for argument in declared)


def test_topics_keep_their_names_by_default(entities: list[Any]) -> None:
    """A remapping changes nothing until its argument is given."""
    defaults = {
        argument.name: argument.default_value
        for argument in _only(DeclareLaunchArgument, entities)
    }
    for node in _only(Node, entities):
        assert {topic for topic, _ in node.remappings} >= {'ownship'}
        assert all(defaults[new.variable_name] == topic for topic, new in node.remappings)


def test_parameter_file_is_shipped(entities: list[Any], setup_arguments: dict[str, Any]) -> None:
    """The default parameter file is one that setup.py installs."""
    (default,) = [
        argument.default_value
        for argument in _only(DeclareLaunchArgument, entities)
        if argument.name == 'params_file'
    ]
    share, *path = default.substitutions
    assert share == FindPackageShare(setup_arguments['name'])
    shipped = dict(setup_arguments['data_files'])[f'share/{share.package}/{path[0]}']
    assert '/'.join(path) in shipped


def test_switches_arrive_as_booleans(entities: list[Any]) -> None:
    """Launch arguments are text; the node declares these two as booleans."""
    for node in _only(Node, entities):
        values = {
            name: each for part in _only(dict, node.parameters) for name, each in part.items()
        }
        assert values == {
            name: ParameterValue(LaunchConfiguration(name), value_type=bool)
            for name in ('use_sim_time', 'autostart')
        }
