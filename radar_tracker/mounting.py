# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where is the radar, how is it turned, and so where does it look?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_tracker.sensor_config import MountConfig, SensorConfig
from radar_tracker.sweep import Sweep
from tracking_core.batches import Coverage, Floats, NO_SWING, Plots
from tracking_core.platform_pose import PlatformPose

_LEAST_UPRIGHT = 0.1  # of the deck's normal; a radar that lies on its side sees no horizon


def sensor_pose(pose: PlatformPose, mount: MountConfig) -> tuple[Floats | None, Floats]:
    """
    Return rotation (M, 3, 3) from sensor to tracking axes and the sensor's position (M, 3).

    The rotation is None where the axes are the same, as without own ship.
    """
    place = np.array([mount.x, mount.y, mount.z])
    if mount.yaw == 0.0 and not pose.orientation[:, :3].any():
        return None, pose.position + place
    platform, c, s = pose.rotation, np.cos(mount.yaw), np.sin(mount.yaw)
    rotation = platform @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return rotation, pose.position + platform @ place


def arm_velocity(pose: PlatformPose, mount: MountConfig) -> Floats:
    """Return how fast the sensor moves (M, 3) [m/s] because the platform turns it round."""
    arm = np.array([mount.x, mount.y, mount.z])
    if not (arm.any() and pose.turn_rate.any()):
        return np.zeros_like(pose.velocity)
    return np.asarray(np.einsum('mij,mj->mi', pose.rotation, np.cross(pose.turn_rate, arm)))


def levelled(rotation: Floats, place: Floats) -> Floats:
    """
    Return rotations (M, 3, 3) about the vertical for what a fan beam saw at places (M, 3).

    The fan of a 2-D radar stands on the platform's deck. It meets the horizon where the deck's
    normal and the direction on the deck span it; the range is the one over the ground, however
    the platform rolls.
    """
    normal = rotation[:, :, 2]
    ray = np.einsum('mij,mj->mi', rotation[:, :, :2], place[:, :2])
    ray = ray - (ray[:, 2] / np.maximum(normal[:, 2], _LEAST_UPRIGHT))[:, None] * normal
    angle = np.arctan2(ray[:, 1], ray[:, 0]) - np.arctan2(place[:, 1], place[:, 0])
    return _about_vertical(angle)


def _about_vertical(angle: Floats) -> Floats:
    """Return rotations (M, 3, 3); scipy's of Ubuntu 24.04 refuses to make none."""
    rotation = np.zeros((len(angle), 3, 3))
    rotation[:, 0, 0] = rotation[:, 1, 1] = np.cos(angle)
    rotation[:, 1, 0] = np.sin(angle)
    rotation[:, 0, 1] = -rotation[:, 1, 0]
    rotation[:, 2, 2] = 1.0
    return rotation


def in_sensor_axes(plots: Plots, pose: PlatformPose, mount: MountConfig) -> Plots:
    """
    Return plots whose directions are true ones, own ship's attitude in them, in the sensor's axes.

    Parameters
    ----------
    plots : Plots
        M plots, polar or Cartesian, from the sensor but in the axes of the tracking frame.
    pose : PlatformPose
        At their times.
    mount : MountConfig
        How the sensor is turned.

    """
    rotation, _ = sensor_pose(pose, mount)
    if rotation is None:
        return plots
    back = np.swapaxes(rotation, 1, 2)
    e, a = np.nan_to_num(plots.elevation), plots.azimuth
    ray = np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=1)
    x, y, z = np.einsum('mij,mj->mi', back, ray).T
    azimuth, elevation = np.arctan2(y, x), np.arcsin(np.clip(z, -1.0, 1.0))
    elevation = np.where(np.isnan(plots.elevation), np.nan, elevation)
    place, noise = _turned_back(back, plots.position), plots.position_covariance.copy()
    # What the noise has to do with heights, which may be NaN, is left out and does not spread.
    ground_back = _about_vertical(-(pose.yaw + mount.yaw))[:, :2, :2]
    noise[:, :2, :] = ground_back @ noise[:, :2, :]
    noise[:, :, :2] = noise[:, :, :2] @ np.swapaxes(ground_back, 1, 2)
    return replace(
        plots, azimuth=azimuth, elevation=elevation, position=place, position_covariance=noise
    )


def _turned_back(back: Floats, position: Floats) -> Floats:
    """Return places (M, 3) in other axes; without a height the distance over the ground stays."""
    is_flat = np.isnan(position[:, 2])
    place = np.einsum('mij,mj->mi', back, np.where(np.isnan(position), 0.0, position))
    ground = np.hypot(position[:, 0], position[:, 1])
    stretch = ground / np.maximum(np.hypot(place[:, 0], place[:, 1]), 1e-9)
    place[is_flat, :2] *= stretch[is_flat, None]
    place[is_flat, 2] = np.nan
    return np.where(np.isnan(position[:, :1]), np.nan, place)


def coverage_of(sweep: Sweep, poses: PlatformPose, sensor: SensorConfig) -> Coverage:
    """
    Turn what the antenna swept into the tracking frame.

    Parameters
    ----------
    sweep : Sweep
        In sensor axes.
    poses : PlatformPose
        In even steps from start to end.
    sensor : SensorConfig
        Mount and limits.

    """
    rotation, place = sensor_pose(poses, sensor.mount)
    begin, end, swing = (0.0, 0.0, NO_SWING) if rotation is None else _turned(rotation, sweep)
    duration = sweep.end_time - sweep.start_time
    velocity = (place[-1] - place[0]) / duration if duration > 0.0 else np.zeros(3)
    x, y, z = (0.5 * (place[0] + place[-1])).tolist()
    return Coverage(
        start_time=sweep.start_time,
        end_time=sweep.end_time,
        start_azimuth=sweep.start_azimuth + begin,
        sweep=sweep.angle + end - begin if sweep.angle else 0.0,
        gaps=sweep.gaps,
        unevenness=sweep.unevenness,
        sensor_position=(x, y, z),
        sensor_velocity=tuple(velocity.tolist()),
        range_min=sensor.range_min,
        range_max=sensor.range_max,
        sector_centre=sensor.sector_centre + float(poses.yaw[-1]) + sensor.mount.yaw,
        sector_width=sensor.sector_width,
        tilt=0.0 if rotation is None else float(np.arccos(min(rotation[:, 2, 2].min(), 1.0))),
        swing=swing,
    )


def _turned(rotation: Floats, sweep: Sweep) -> tuple[float, float, tuple[float, ...]]:
    """
    Return how far the platform has turned what the antenna points at [rad].

    At the start, at the end, and, in a long sweep, how far ahead it is of an even turn meanwhile.
    """
    share = np.linspace(0.0, 1.0, len(rotation))
    azimuth = sweep.start_azimuth + sweep.angle * share
    on_deck = np.stack([np.cos(azimuth), np.sin(azimuth), 0.0 * azimuth], axis=1)
    about = levelled(rotation, on_deck)
    turned = np.unwrap(np.arctan2(about[:, 1, 0], about[:, 0, 0]))
    begin, end = float(turned[0]), float(turned[-1])
    if not (sweep.angle and sweep.is_long):
        return begin, end, NO_SWING
    return begin, end, tuple((turned - (begin + (end - begin) * share)).tolist())
