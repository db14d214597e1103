# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How contacts become a radar_msgs/RadarTracks; what is not known is NaN."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np

from msg_adapters.bodies import Bodies
from msg_adapters.message_types import MessageTypes, seconds
from tracking_core.batches import Floats, Ints

NAME = 'radar_msgs/RadarTracks'
PACKAGE = NAME.partition('/')[0]
UNKNOWN, STATIC, DYNAMIC = 0, 1, 2  # classification, by the numbers of the message
MOVING = 9.21  # velocity squared over its covariance that a contact at rest exceeds in 1 % (2-D)
SURE = 1.0  # m/s: with a wider sd, a contact is not called static
RUN, REST = 8, 8  # bytes of a uuid: of this run, then of the track's id
_UPPER = np.triu_indices(3)


class RadarClasses(NamedTuple):
    """Message classes of the packages that radar_msgs brings."""

    RadarTracks: Any
    RadarTrack: Any
    UUID: Any


def radar_classes() -> RadarClasses:
    """
    Return the classes of rclpy.

    Raises
    ------
    ValueError
        Where the package is not installed; says which.

    """
    try:
        msgs = import_module(f'{PACKAGE}.msg')
        return RadarClasses(
            msgs.RadarTracks, msgs.RadarTrack, import_module('unique_identifier_msgs.msg').UUID
        )
    except ImportError as error:
        raise ValueError(
            f'output_type {NAME} needs the package {PACKAGE}, which is not installed '
            '(ros-$ROS_DISTRO-radar-msgs)'
        ) from error


def available() -> list[str]:
    """Return what `output_type` can be here."""
    return [NAME] if find_spec(PACKAGE) is not None else []


def to_radar_tracks(
    bodies: Bodies, run: bytes, header: Any, types: MessageTypes, classes: RadarClasses
) -> Any:
    """
    Return the contacts as one message: all as they are at its one stamp.

    Parameters
    ----------
    bodies : Bodies
        T contacts.
    run : bytes
        Eight bytes that no other run of a node has; ids begin anew with every run.
    header : Header
        Of the scan, in the tracking frame.
    types : MessageTypes
        Of positions and velocities.
    classes : RadarClasses
        Of the rest.

    """
    bodies = bodies.at(seconds(header.stamp))
    with np.errstate(over='ignore'):  # beyond float32 is infinite
        place, speed = (_upper(bodies.covariance[:, at, at]) for at in (slice(0, 3), slice(3, 6)))
    kinds = classify(bodies.state[:, 3:5], bodies.covariance[:, 3:5, 3:5]).tolist()
    rows = zip(bodies.id.tolist(), bodies.state.tolist(), kinds, place, speed, strict=True)
    tracks = [_track(row, run, types, classes) for row in rows]
    return classes.RadarTracks(header=header, tracks=tracks)


def classify(velocity: Floats, covariance: Floats) -> Ints:
    """Return which contacts move, (T, 2) and (T, 2, 2): `DYNAMIC`, `STATIC`, else `UNKNOWN`."""
    a, b, c = covariance[:, 0, 0], covariance[:, 0, 1], covariance[:, 1, 1]
    vx, vy = velocity.T
    with np.errstate(invalid='ignore', divide='ignore', over='ignore'):
        distance = (c * vx**2 - 2.0 * b * vx * vy + a * vy**2) / (a * c - b**2)
        moving, sure = distance > MOVING, np.maximum(a, c) < SURE**2
    return np.where(moving, DYNAMIC, np.where(sure, STATIC, UNKNOWN))


def _upper(covariance: Floats) -> Any:
    """Return xx, xy, xz, yy, yz, zz (T, 6)."""
    return covariance[:, _UPPER[0], _UPPER[1]].astype(np.float32, order='C')


def _track(row: Any, run: bytes, types: MessageTypes, classes: RadarClasses) -> Any:
    identity, (x, y, z, vx, vy, vz), kind, place, speed = row
    unknown = types.Vector3(x=np.nan, y=np.nan, z=np.nan)
    nothing = np.full(6, np.nan, np.float32)
    name = run[:RUN] + int(identity).to_bytes(REST, 'big')
    return classes.RadarTrack(
        uuid=classes.UUID(uuid=np.frombuffer(name, np.uint8)),
        position=types.Point(x=x, y=y, z=z),
        velocity=types.Vector3(x=vx, y=vy, z=vz),
        acceleration=unknown,
        size=unknown,
        classification=kind,
        position_covariance=place,
        velocity_covariance=speed,
        acceleration_covariance=nothing,
        size_covariance=nothing,
    )
