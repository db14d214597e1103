# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How tracks become Odometry messages: x axis along the course, twist in that frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.message_types import MessageTypes
from tracking_core.batches import Floats

UNKNOWN = 1e9  # variance of what is not estimated; NaN would break readers
LARGEST_YAW_VARIANCE = np.pi**2 / 3.0  # of a course that may be anything


def to_odometry(bodies: Bodies, frame: str, types: MessageTypes) -> list[Any]:
    """Return one Odometry for each contact, stamped with the time of its state."""
    state, covariance = bodies.state, bodies.covariance
    course = np.arctan2(state[:, 4], state[:, 3])
    speed = np.hypot(state[:, 3], state[:, 4])
    pose, twist = _covariances(covariance, course, speed)
    half = 0.5 * course
    turns = np.stack([np.sin(half), np.cos(half)], axis=1)
    columns = (bodies.time, bodies.id, state, speed, turns, pose, twist)
    rows = zip(*(column.tolist() for column in columns[:5]), *columns[5:], strict=True)
    return [_message(row, frame, types) for row in rows]


def _message(row: Any, frame: str, types: MessageTypes) -> Any:
    time, identity, (x, y, z, _, _, vz), speed, (sine, cosine), pose, twist = row
    nothing = types.Vector3(x=0.0, y=0.0, z=0.0)
    return types.Odometry(
        header=types.header(time, frame),
        child_frame_id=f'track_{identity}',
        pose=types.PoseWithCovariance(
            pose=types.Pose(
                position=types.Point(x=x, y=y, z=z),
                orientation=types.Quaternion(x=0.0, y=0.0, z=sine, w=cosine),
            ),
            covariance=pose,
        ),
        twist=types.TwistWithCovariance(
            twist=types.Twist(linear=types.Vector3(x=speed, y=0.0, z=vz), angular=nothing),
            covariance=twist,
        ),
    )


def _covariances(covariance: Floats, course: Floats, speed: Floats) -> tuple[Floats, Floats]:
    """Return the covariances (T, 36) of pose and of twist, the latter in the child's axes."""
    rows = len(covariance)
    rotation = np.zeros((rows, 3, 3))
    rotation[:, 0, 0] = rotation[:, 1, 1] = np.cos(course)
    rotation[:, 0, 1], rotation[:, 1, 0] = np.sin(course), -np.sin(course)
    rotation[:, 2, 2] = 1.0
    known = np.where(np.isnan(covariance), UNKNOWN, covariance)
    velocity = rotation @ known[:, 3:, 3:] @ rotation.swapaxes(1, 2)
    pose, twist = np.zeros((rows, 6, 6)), np.zeros((rows, 6, 6))
    pose[:, :3, :3], twist[:, :3, :3] = known[:, :3, :3], velocity
    # To first order the course errs by the velocity error across it over the speed.
    across = velocity[:, 1, 1] / np.maximum(speed, np.finfo(float).tiny) ** 2
    pose[:, 5, 5] = np.minimum(across, LARGEST_YAW_VARIANCE)
    twist[:, 5, 5] = UNKNOWN
    return pose.reshape(-1, 36), twist.reshape(-1, 36)
