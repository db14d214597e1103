# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where were the plots of a recording, in the frame of its tracks, however old own ship is?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.plots import to_plots
from msg_adapters.table import Columns
from radar_tracker.mounting import in_sensor_axes, levelled, sensor_pose
from radar_tracker.sensor_config import MountConfig, SensorConfig
from tracking_core.batches import Floats, Plots
from tracking_core.platform import Platform, pose_at
from tracking_session.frames import TrackingFrame
from tracking_tools.bags import MAX_ROWS


@dataclass(frozen=True)
class PlotPlaces:
    """
    Brings the plots of messages into the tracking frame.

    Parameters
    ----------
    sensor : SensorConfig
        Conventions of the plots, and the mount.
    fields : mapping
        Our names of their fields to those of the messages.
    platform : Platform or None
        Own ship in the tracking frame, if there is one.
    frame : str
        The tracking frame.

    """

    sensor: SensorConfig
    fields: Mapping[str, str]
    platform: Platform | None
    frame: str

    def of(self, msg: Any) -> Columns:
        """Return x, y, sensor_x, sensor_y and time of a message's plots; of a bad one nothing."""
        mount = self.sensor.mount
        frame = TrackingFrame(self.frame, mount != MountConfig(), lambda _: None)
        frame.has_ship = self.platform is not None
        try:
            reading = to_plots(msg, self.sensor, MAX_ROWS, self.fields)
            frame.check_plots(reading.plots.frame, reading.is_polar)
        except BadMessage:
            return {'time': np.zeros(0)}
        plots = reading.plots
        pose = pose_at(self.platform if frame.needs_platform else None, plots.time)
        if frame.tells_true(self.sensor.azimuth_reference):
            plots = in_sensor_axes(plots, pose, mount)
        turn, origin = sensor_pose(pose, mount)
        place = _local(plots)
        if turn is not None:
            told = np.isfinite(plots.elevation) | np.isfinite(plots.position[:, 2])
            if self.sensor.dimensions == 2 or not told.any():
                turn = levelled(turn, place)
            place = np.einsum('mij,mj->mi', turn, place)
        x, y, _ = (place + origin).T
        return {
            'x': x, 'y': y, 'sensor_x': origin[:, 0], 'sensor_y': origin[:, 1], 'time': plots.time
        }  # fmt: skip


def _local(plots: Plots) -> Floats:
    """Return where plots are from the sensor (M, 3), level where nothing tells their height."""
    elevation = np.nan_to_num(plots.elevation)
    level = plots.range * np.cos(elevation)
    polar = np.stack(
        [
            level * np.cos(plots.azimuth),
            level * np.sin(plots.azimuth),
            plots.range * np.sin(elevation),
        ],
        axis=1,
    )
    told = np.where(np.isfinite(plots.range)[:, None], polar, plots.position)
    return np.nan_to_num(told)
