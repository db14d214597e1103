# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the odometry of the sensor's platform is read: pose in its frame, twist in the child's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import stamp_of
from tracking_core.batches import Floats
from tracking_core.platform import Platform

UNIT = 0.01  # how far the length of a quaternion may be from 1
FARTHEST = 1e8  # m, or m/s: beyond is no platform
ANY_PLACE, ANY_YAW = 1e6, np.pi**2 / 3.0  # m^2 over the ground, rad^2: more is not known at all
_ROUNDING = 1e-9  # of the variances, by which an eigenvalue may be negative
Tell = Callable[[str, str], object]  # takes a reason, without values, and a text


def to_platform(msg: Any, tell: Tell = lambda reason, text: None) -> Platform:
    """
    Return one sample of the platform from an Odometry message.

    A covariance that is none, or that is of a pose which is anywhere, counts as zero.

    Parameters
    ----------
    msg : Odometry
        Pose in its frame, twist in the child's.
    tell : callable
        Told of what is not used.

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
    return Platform(
        time=np.array([stamp_of(msg)]),
        position=position[None],
        orientation=orientation[None] / length,
        velocity=Rotation.from_quat(orientation).apply(velocity)[None],
        position_covariance=_place_noise(covariance[:3, :3], tell)[None],
        yaw_variance=_yaw_noise(covariance[5:, 5], tell),
    )


def _numbers(field: str, part: Any, names: str) -> Floats:
    values = np.array([getattr(part, name) for name in names], np.float64)
    if not (np.abs(values) <= FARTHEST).all():
        raise BadMessage('not finite', f'{field} is {", ".join(f"{value:g}" for value in values)}')
    return values


def _place_noise(covariance: Floats, tell: Tell) -> Floats:
    """Return the covariance (3, 3) of a place within reach, zero where it is that of none."""
    variance, most = np.diagonal(covariance), [ANY_PLACE, ANY_PLACE, FARTHEST**2]
    if np.isfinite(covariance).all() and ((variance >= 0.0) & (variance <= most)).all():
        least = np.linalg.eigvalsh(0.5 * covariance + 0.5 * covariance.T)[0]
        if least >= -_ROUNDING * variance.sum():
            return covariance
    told = ', '.join(f'{value:g}' for value in variance)
    tell(
        'covariance of the place',
        f'pose.covariance is that of no place (variances of x y z = {told} m^2): own ship is '
        'taken to be sure of its place',
    )
    return np.zeros((3, 3))


def _yaw_noise(variance: Floats, tell: Tell) -> Floats:
    """Return the variance (1,) of a heading, zero where it is that of none."""
    if 0.0 <= variance[0] <= ANY_YAW:
        return variance
    tell(
        'variance of the heading',
        f'pose.covariance[35] = {variance[0]:g} rad^2 is that of no heading: own ship is taken '
        'to be sure of its heading. Where nobody knows it, only plots with '
        'sensor.azimuth_reference: tracking_frame are tracked rightly',
    )
    return np.zeros(1)
