# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What is a bearing that was taken on a deck which rolls and pitches? That on the horizon.

An array that parts all bearings measures in the plane of the deck; a linear one the angle from its
axis, which is a cone about it. Contacts are on the horizon.
"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle
from tracking_core.platform_pose import PlatformPose

_LEAST_UPRIGHT = 0.1  # of the deck's normal; a sensor on its side or head is taken for level


def to_horizon(bearing: Floats, pose: PlatformPose, yaw: float, is_linear: bool) -> Floats:
    """
    Return bearings in tracking axes (M,) [rad] of marks in sensor axes.

    Parameters
    ----------
    bearing : (M,) array
        Anticlockwise from the sensor's axis [rad].
    pose : PlatformPose
        Platform at the times of the marks.
    yaw : float
        Of the sensor on its platform [rad].
    is_linear : bool
        The sensor is a linear array.

    """
    level = wrap_angle(bearing + pose.yaw + yaw)
    if not _is_tilted(pose):
        return level
    deck = pose.rotation
    if is_linear:
        heading, length = _axis(deck, yaw)
        cosine = np.clip(np.cos(bearing) / length, -1.0, 1.0)
        found = heading + np.copysign(np.arccos(cosine), wrap_angle(bearing))
    else:
        normal, ray = deck[:, :, 2], _on_deck(deck, bearing + yaw)
        ray = ray - (ray[:, 2] / np.maximum(normal[:, 2], _LEAST_UPRIGHT))[:, None] * normal
        found = np.arctan2(ray[:, 1], ray[:, 0])
    return np.where(deck[:, 2, 2] > _LEAST_UPRIGHT, wrap_angle(found), level)


def from_horizon(bearing: Floats, pose: PlatformPose, yaw: float, is_linear: bool) -> Floats:
    """Return marks in sensor axes (M,) of bearings in tracking axes [rad]: see `to_horizon`."""
    level = wrap_angle(bearing - pose.yaw - yaw)
    if not _is_tilted(pose):
        return level
    deck = pose.rotation
    if is_linear:
        heading, length = _axis(deck, yaw)
        off = wrap_angle(bearing - heading)
        found = np.copysign(np.arccos(length * np.cos(off)), off)
    else:
        ray = np.stack([np.cos(bearing), np.sin(bearing)], axis=1)
        x, y = np.einsum('mij,mi->jm', deck[:, :2, :2], ray)
        found = np.arctan2(y, x) - yaw
    return np.where(deck[:, 2, 2] > _LEAST_UPRIGHT, wrap_angle(found), level)


def _is_tilted(pose: PlatformPose) -> bool:
    return bool(pose.orientation[:, :2].any())


def _on_deck(deck: Floats, angle: Floats) -> Floats:
    """Return the directions (M, 3) at angles (M,) from the platform's x axis on its deck [rad]."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return np.asarray(cos * deck[:, :, 0] + sin * deck[:, :, 1])


def _axis(deck: Floats, yaw: float) -> tuple[Floats, Floats]:
    """Return heading (M,) [rad] of a linear array's axis, and the length of its shadow (M,)."""
    x, y, _ = _on_deck(deck, np.full(len(deck), yaw)).T
    return np.arctan2(y, x), np.hypot(x, y)
