# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How config dataclasses become the parameters of a node, and stay what the node runs with.

Everything about a parameter is written once, in its config: here it is declared, checked and
followed while the node runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)

from tracking_core.config import hint, LARGEST, Parameter, parameters, with_values
from tracking_node.qos_overrides import complaint, is_override
from tracking_session.node_config import Configs, TELLING
from tracking_session.other_sensor import other_sensor

# What rclpy declares by itself, and what only says something.
_OTHERS = ('use_sim_time', 'start_type_description_service', *TELLING)


class BadParameter(ValueError):  # noqa: N818 (it is the parameter that is bad)
    """A parameter that the node cannot run with; names the parameter, the limit and the value."""


class NodeParameters:
    """
    The parameters of one node.

    Parameters
    ----------
    node : rclpy.node.Node
        Where they are declared, with the values that files and arguments give.
    configs : tuple of dataclasses
        Defaults; no name occurs in two of them.
    changed : callable
        Called with the new configs after a change while the node runs.

    Raises
    ------
    BadParameter
        For a value outside its limits or of another type.

    """

    configs: Configs

    def __init__(self, node: Any, configs: Configs, changed: Callable[[Configs], None]) -> None:
        given = overrides(node)
        for name in filter(is_override, given):
            if wrong := complaint(name, given[name]):
                raise BadParameter(f'parameter {wrong}')
        known = {entry.name for entry in _all_parameters(configs)}
        try:
            self.configs = _with_values(configs, given)
        except BadParameter as error:
            raise BadParameter(f'{error}{other_sensor(given, known)}') from error
        self._changed, self.logger = changed, node.get_logger()
        for entry in _all_parameters(self.configs):
            node.declare_parameter(
                entry.name, _to_ros(entry.value), describe(entry), ignore_override=True
            )
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._follow)
        self.unknown = _unknown(given, known)
        self.given = len(given) - len(self.unknown)

    def tell(self) -> None:
        """Say how many parameters were given, and which names nobody knows."""
        if self.given:
            self.logger.info(f'{self.given} parameters come from files or arguments')
        for name, meant in self.unknown.items():
            self.logger.warning(f'there is no parameter {name}, it has no effect{meant}')

    def tell_idle_overrides(self, node: Any) -> None:
        """Say which overrides of quality of service are for topics that the node does not open."""
        for name in filter(is_override, overrides(node)):
            if not node.has_parameter(name):
                self.logger.warning(f'there is no topic for {name}, it has no effect')

    def _check(self, changes: list[Any]) -> SetParametersResult:
        """Say whether the node could run with these changes together."""
        try:
            _with_values(self.configs, {change.name: change.value for change in changes})
        except BadParameter as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _follow(self, changes: list[Any]) -> None:
        configs = _with_values(self.configs, {change.name: change.value for change in changes})
        if configs != self.configs:
            self.configs = configs
            self._changed(configs)


def overrides(node: Any) -> dict[str, Any]:
    """Return the values that files and arguments give this node, by parameter name."""
    # rclpy has no public way to see names that nobody declares; typing errors are among them.
    return {name: given.value for name, given in node._parameter_overrides.items()}


def describe(entry: Parameter) -> ParameterDescriptor:
    """Return what `ros2 param describe` shows; an int is accepted for a double."""
    unit = f' [{entry.unit}]' if entry.unit else ''
    descriptor = ParameterDescriptor(
        description=f'{entry.doc}{unit}',
        additional_constraints=f'one of: {", ".join(entry.choices)}' if entry.choices else '',
        read_only=not entry.live,
        dynamic_typing=True,
    )
    bounded = entry.low is not None or entry.high is not None
    low = -LARGEST if entry.low is None else entry.low
    high = LARGEST if entry.high is None else entry.high
    if bounded and isinstance(entry.value, float):
        descriptor.floating_point_range = [
            FloatingPointRange(from_value=float(low), to_value=float(high), step=0.0)
        ]
    elif bounded and isinstance(entry.value, int):
        descriptor.integer_range = [IntegerRange(from_value=int(low), to_value=int(high), step=1)]
    elif bounded:  # a list: ROS has no ranges for these
        descriptor.additional_constraints = f'each in [{low:g}, {high:g}]'
    return descriptor


def _all_parameters(configs: Configs) -> Iterator[Parameter]:
    for config in configs:
        yield from parameters(config)


def _to_ros(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _with_values(configs: Configs, values: Mapping[str, Any]) -> Configs:
    """Return the configs with those of the values that are theirs."""
    return tuple(_with_own_values(config, values) for config in configs)


def _with_own_values(config: Any, values: Mapping[str, Any]) -> Any:
    own = {p.name: values[p.name] for p in parameters(config) if p.name in values}
    for name, value in own.items():
        if value is None:  # rclpy's word for an empty list of a file or an argument
            raise BadParameter(f'parameter {name} has no value')
    try:
        return with_values(config, own)
    except (TypeError, ValueError) as error:  # an array where a number belongs is a TypeError
        raise BadParameter(_in_words(own, str(error))) from error


def _in_words(own: Mapping[str, Any], text: str) -> str:
    """Return the error, with all that was given where it does not begin with one of these."""
    if text.partition(' ')[0] in own:
        return f'parameter {text}'
    given = ', '.join(f'{name} = {value!r}' for name, value in own.items())
    return f'parameters {given}: {text}'


def _unknown(given: Mapping[str, Any], known: set[str]) -> dict[str, str]:
    """Return the names that no config has, each with a word on what was probably meant, or ''."""
    others = {name for name in given if name in _OTHERS or is_override(name)}
    unknown = given.keys() - known - others
    return {name: hint(name, known) or other_sensor([name], known) for name in sorted(unknown)}
