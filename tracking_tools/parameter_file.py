# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a ROS parameter file is read without ROS, and what it says about one node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from tracking_core.config import hint, parameters, with_values
from tracking_session.node_config import Configs, TELLING
from tracking_session.other_sensor import other_sensor
from tracking_session.parameter_blocks import BadParameterFile, blocks_for, Loader, read_blocks

# Parameters that every node of ROS has, or that only say something; nothing to a recording.
OTHERS = ('use_sim_time', 'qos_overrides.', 'start_type_description_service', *TELLING)


def read_parameter_file(path: Path | str, node: str) -> dict[str, Any]:
    """
    Return what a parameter file in ROS form says about one node, by dotted name.

    Parameters
    ----------
    path : Path or str
        YAML file; blocks keyed ``/**``, the node's name or a pattern that fits it are used, a
        later block overrides an earlier one.
    node : str
        Full name of the node, as ``/radar_tracker``.

    Raises
    ------
    BadParameterFile
        If there is no such file, it is not a parameter file, or no block of it is for this node.

    """
    values: dict[str, Any] = {}
    for block in blocks_for(node, read_blocks(path), path):
        values |= {name: _checked(name, value, path) for name, value in _flat(block, '')}
    return values


def parse_value(text: str) -> Any:
    """Return the value that a text means in a parameter file; raises BadParameterFile."""
    try:
        return yaml.load(text, Loader)  # noqa: S506 (a SafeLoader)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise BadParameterFile(f'{text!r} is not a value: {error}') from error


def configure(configs: Configs, values: Mapping[str, Any]) -> Configs:
    """
    Return the configs with these values, each where its name is known.

    Parameters
    ----------
    configs : tuple of dataclasses
        No name occurs in two of them.
    values : mapping
        By dotted name.

    Raises
    ------
    ValueError
        For a name that none of them knows, with the nearest that one does, or a value outside
        its limits.

    """
    names = [[entry.name for entry in parameters(config)] for config in configs]
    known = [name for own in names for name in own]
    for name in values:
        if name not in known and not name.startswith(OTHERS):
            meant = hint(name, known) or other_sensor([name], known)
            raise ValueError(f'unknown parameter {name}{meant}')
    return tuple(
        with_values(config, {name: values[name] for name in own if name in values})
        for config, own in zip(configs, names, strict=True)
    )


def _flat(tree: Mapping[Any, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from _flat(value, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', value


def _checked(name: str, value: Any, path: Path | str) -> Any:
    """Return the value, if ROS would read it too."""
    if value is None:
        raise BadParameterFile(f'{path}: {name} has no value')
    kinds = {type(item) for item in value} if isinstance(value, Sequence) else set()
    if isinstance(value, list) and (len(kinds) > 1 or kinds & {list, dict, type(None)}):
        raise BadParameterFile(
            f'{path}: {name} = {value}: ROS takes flat lists of one type; write 1.0, not 1, among '
            'numbers with a point'
        )
    return value
