# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which messages plots and bearings may come in, and how each becomes named columns.

Everything after the columns (synonyms, conventions, checks of rows) is the same for all types.
Packages beyond common_interfaces are imported only when a user asks for their type.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple

from msg_adapters.bad_message import BadMessage
from msg_adapters.kinds.detections_3d import detections_3d
from msg_adapters.kinds.laser_scan import laser_scan
from msg_adapters.kinds.poses import pose_array, pose_with_covariance
from msg_adapters.kinds.radar_scan import radar_scan
from msg_adapters.kinds.sonar_detections import sonar_detections
from msg_adapters.table import Columns, to_columns

POINT_CLOUD = 'sensor_msgs/PointCloud2'
SINGLE = 'geometry_msgs/PoseWithCovarianceStamped'  # one plot a message


class Kind(NamedTuple):
    """One type of message."""

    size: Callable[[Any], int]  # rows, before any is read
    columns: Callable[[Any], Columns]


MENU = {
    'sensor_msgs/LaserScan': Kind(lambda msg: len(msg.ranges), laser_scan),
    'geometry_msgs/PoseArray': Kind(lambda msg: len(msg.poses), pose_array),
    SINGLE: Kind(lambda _: 1, pose_with_covariance),
    'radar_msgs/RadarScan': Kind(lambda msg: len(msg.returns), radar_scan),
    'vision_msgs/Detection3DArray': Kind(lambda msg: len(msg.detections), detections_3d),
    'marine_acoustic_msgs/SonarDetections': Kind(
        lambda msg: len(msg.two_way_travel_times), sonar_detections
    ),
}
TYPES = (POINT_CLOUD, *MENU)
ECHOES = 'has raw echoes, not plots: a plot extractor (threshold and clustering) must come first'
NOT_PLOTS = {
    'marine_sensor_msgs/RadarSector': ECHOES,
    'marine_sensor_msgs/RadarEcho': ECHOES,
    'marine_acoustic_msgs/ProjectedSonarImage': ECHOES,
    'marine_acoustic_msgs/RawSonarImage': ECHOES,
}


def columns_of(msg: Any, max_rows: int) -> Columns:
    """
    Return the columns of a message by name, (M,) each.

    Raises
    ------
    BadMessage
        For a type that holds no plots, too many rows, or sizes that do not fit.

    """
    name = _name_of(type(msg))
    if name == POINT_CLOUD:
        return to_columns(msg, max_rows)
    try:
        kind = MENU[check_type(name)]
    except ValueError as error:
        raise BadMessage('wrong type', str(error)) from error
    rows = kind.size(msg)
    if rows > max_rows:
        raise BadMessage('too many rows', f'{name} has {rows} rows, limit {max_rows}')
    return kind.columns(msg)


def is_single(msg: Any) -> bool:
    """Return whether messages of this type have one plot each."""
    return _name_of(type(msg)) == SINGLE


def tells_unit(msg: Any) -> bool:
    """Return whether the type of a message says that its angles are radians, or quaternions."""
    return _name_of(type(msg)) != POINT_CLOUD


def check_type(name: str) -> str:
    """Return 'package/Type' for that or 'package/msg/Type'; ValueError if it holds no plots."""
    short = name.replace('/msg/', '/')
    if short in NOT_PLOTS:
        raise ValueError(f'{short} {NOT_PLOTS[short]}')
    if short not in TYPES:
        raise ValueError(f'{short!r} cannot be read, one of: {", ".join(TYPES)}')
    return short


def message_class(name: str) -> Any:
    """
    Return the class of rclpy for a type.

    Raises
    ------
    ValueError
        For a type that is not on the menu, or whose package is not installed; says which.

    """
    package, _, kind = check_type(name).partition('/')
    try:
        return getattr(import_module(f'{package}.msg'), kind)
    except ImportError as error:
        raise ValueError(
            f'input_type {name} needs the package {package}, which is not installed '
            f'(ros-$ROS_DISTRO-{package.replace("_", "-")}); here are: {", ".join(available())}'
        ) from error


def available() -> list[str]:
    """Return the types whose packages are installed."""
    return [name for name in TYPES if find_spec(name.partition('/')[0]) is not None]


def _name_of(kind: type) -> str:
    """Return 'package/Type' of a class of rclpy or of rosbags."""
    of_rosbags = getattr(kind, '__msgtype__', '')
    return (of_rosbags or f'{kind.__module__.partition(".")[0]}/{kind.__name__}').replace(
        '/msg/', '/'
    )
