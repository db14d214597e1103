# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which classes messages are made of: those of rclpy, or those of rosbags.

An adapter takes the classes as an argument, so the same lines serve the live node and the replay
of a bag. Classes of rosbags have no defaults: adapters name every field.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage

NANOSECONDS = 1_000_000_000
EARLIEST, LATEST = -(2.0**31), 2.0**31 - 1.0  # s since the epoch that a stamp can tell


@dataclass(frozen=True)
class MessageTypes:
    """Message classes, and how they want bytes."""

    to_bytes: Callable[[bytes], Any]  # for fields of type uint8[]
    Time: Any
    Duration: Any
    Header: Any
    ColorRGBA: Any
    PointCloud2: Any
    PointField: Any
    CompressedImage: Any
    Point: Any
    Vector3: Any
    Quaternion: Any
    Pose: Any
    PoseWithCovariance: Any
    Twist: Any
    TwistWithCovariance: Any
    Odometry: Any
    Marker: Any
    MarkerArray: Any
    MeshFile: Any
    DiagnosticArray: Any
    DiagnosticStatus: Any
    KeyValue: Any

    def header(self, time: float, frame: str) -> Any:
        """Return a header stamped with `time` [s since the epoch], as near as a stamp can be."""
        time = min(max(time, EARLIEST), LATEST)
        whole = int(time // 1)
        nanosec = round((time - whole) * NANOSECONDS)
        if nanosec == NANOSECONDS:
            whole, nanosec = whole + 1, 0
        return self.Header(stamp=self.Time(sec=whole, nanosec=nanosec), frame_id=frame)


_PACKAGES = {
    'builtin_interfaces': ('Time', 'Duration'),
    'std_msgs': ('Header', 'ColorRGBA'),
    'sensor_msgs': ('PointCloud2', 'PointField', 'CompressedImage'),
    'geometry_msgs': (
        'Point', 'Vector3', 'Quaternion', 'Pose', 'PoseWithCovariance', 'Twist',
        'TwistWithCovariance',
    ),
    'nav_msgs': ('Odometry',),
    'visualization_msgs': ('Marker', 'MarkerArray', 'MeshFile'),
    'diagnostic_msgs': ('DiagnosticArray', 'DiagnosticStatus', 'KeyValue'),
}  # fmt: skip


def seconds(stamp: Any) -> float:
    """Return a message's time or duration [s]."""
    return float(stamp.sec + stamp.nanosec * 1e-9)


def stamp_of(msg: Any) -> float:
    """
    Return when a message says that it was made [s].

    Raises
    ------
    BadMessage
        For nanoseconds that are more than a second.

    """
    stamp = msg.header.stamp
    if not 0 <= stamp.nanosec < NANOSECONDS:
        raise BadMessage('bad stamp', f'header.stamp.nanosec is {stamp.nanosec}, not below 10^9')
    return seconds(stamp)


def frame_of(msg: Any) -> str:
    """Return the frame that a message is told in."""
    return frame_name(msg.header.frame_id)


def frame_name(text: str) -> str:
    """Return a frame's name as ROS 2 and tf2 have it: /map, as ROS 1 wrote it, is map."""
    return text.lstrip('/')


@cache
def rclpy_types() -> MessageTypes:
    """Return the message classes that rclpy publishes."""
    return _collect(
        lambda package, name: getattr(import_module(f'{package}.msg'), name),
        lambda data: array('B', data),
    )


@cache
def rosbags_types() -> MessageTypes:
    """Return the Jazzy message classes of rosbags, which needs no ROS installation."""
    typesys = import_module('rosbags.typesys')
    types = typesys.get_typestore(typesys.Stores.ROS2_JAZZY).types
    return _collect(
        lambda package, name: types[f'{package}/msg/{name}'],
        lambda data: np.frombuffer(data, np.uint8),
    )


def _collect(find: Callable[[str, str], Any], to_bytes: Callable[[bytes], Any]) -> MessageTypes:
    found = {name: find(pkg, name) for pkg, names in _PACKAGES.items() for name in names}
    return MessageTypes(to_bytes=to_bytes, **found)
