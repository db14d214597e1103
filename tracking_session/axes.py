# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What looks wrong with how a sensor on a ship tells its plots?"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from tracking_session.frames import TrackingFrame


class Mount(Protocol):
    """How the sensor is turned on its platform."""

    @property
    def yaw(self) -> float:
        """Return the angle from the platform's x axis [rad]."""


class Axes(Protocol):
    """What a sensor's azimuths count from."""

    @property
    def azimuth_convention(self) -> str:
        """Return 'enu', 'compass' or 'clockwise'."""

    @property
    def azimuth_reference(self) -> str:
        """Return 'frame' or 'tracking_frame'."""

    @property
    def mount(self) -> Mount:
        """Return how it is turned."""


Warn = Callable[[str, str], object]  # with a reason and a text


def check_places(sensor: Axes, scan: Any, frame: TrackingFrame, warn: Warn) -> None:
    """Warn of places in the tracking frame that a mount moves, or that an antenna cannot have."""
    if not frame.has_places:
        return
    if sensor.mount != type(sensor.mount)():
        warn(
            'mount',
            f"plots are places in '{frame.name}', and sensor.mount moves them: they are where "
            'they are, set no mount',
        )
    if scan.assembly != 'snapshot':
        warn(
            'places',
            f"plots are places in '{frame.name}', from a ship that moves: from where the antenna "
            'looked is not known, set scan.assembly to snapshot',
        )


def check_axes(sensor: Axes, frame: TrackingFrame, warn: Warn) -> None:
    """Warn of azimuths that would count from a ship's port beam."""
    if (
        frame.is_from_ship
        and sensor.azimuth_convention == 'compass'
        and not frame.tells_true(sensor.azimuth_reference)
        and sensor.mount.yaw == 0.0
    ):
        warn(
            'axes',
            'sensor.azimuth_convention is compass and own ship moves: azimuths are taken '
            f"clockwise from the y axis of '{frame.sensor}', which is to port. For azimuths from "
            'the bow set it to clockwise; for those from north set sensor.azimuth_reference to '
            'tracking_frame',
        )
