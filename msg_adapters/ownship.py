# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the odometry of the sensor's platform is read: pose in its frame, twist in the child's."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import stamp_of
from tracking_core.batches import Floats
from tracking_core.platform import Platform

UNIT = 0.01  # how far the length of a quaternion may be from 1
FARTHEST = 1e8  # m, or m/s: beyond is no platform
_ROUNDING = 1e-9  # of the variances, by which an eigenvalue may be negative


def to_platform(msg: Any) -> Platform:
    """
    Return one sample of the platform from an Odometry message.

    A covariance that is none, or that is of a pose which is anywhere, counts as zero.

    Raises
    ------
    BadMessage
        For a pose or twist that is not finite, or an orientation or a stamp that is none.

    """
    pose, twist = msg.pose.pose, msg.twist.twist
    position = _numbers('pose.pose.position', pose.position, 'xyz')
    orientation = _numbers('pose.pose.orientation', pose.orientation, 'xyzw')
    velocity = _numbers('twist.twist.linear', twist.linear, 'xyz')
    length = float(np.linalg.norm(orientation))
    if abs(length - 1.0) > UNIT:
        raise BadMessage(
            'bad orientation',
            f'pose.pose.orientation has length {length:.3g}, not 1 '
            f'(x y z w = {", ".join(f"{value:g}" for value in orientation)})',
        )
    covariance = np.asarray(msg.pose.covariance, np.float64).reshape(6, 6)
    if not _is_covariance(covariance):
        covariance = np.zeros((6, 6))
    return Platform(
        time=np.array([stamp_of(msg)]),
        position=position[None],
        orientation=orientation[None] / length,
        velocity=Rotation.from_quat(orientation).apply(velocity)[None],
        position_covariance=covariance[None, :3, :3],
        yaw_variance=covariance[5:, 5],
    )


def _numbers(field: str, part: Any, names: str) -> Floats:
    values = np.array([getattr(part, name) for name in names], np.float64)
    if not (np.abs(values) <= FARTHEST).all():
        raise BadMessage('not finite', f'{field} is {", ".join(f"{value:g}" for value in values)}')
    return values


def _is_covariance(covariance: Floats) -> bool:
    """Return whether a pose (6,) within reach can be as unsure as that."""
    variance, place = np.diagonal(covariance), covariance[:3, :3]
    within = (variance >= 0.0) & (variance <= FARTHEST**2)
    if not (np.isfinite(covariance).all() and within.all()):
        return False
    least = np.linalg.eigvalsh(0.5 * place + 0.5 * place.T)[0]
    return bool(least >= -_ROUNDING * variance[:3].sum())
