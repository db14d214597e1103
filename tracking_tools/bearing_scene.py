# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording of a sonar and its tracks show together, over time and true bearing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.bearings import to_bearings
from msg_adapters.table import Columns
from msg_adapters.track_rows import CONFIRMED
from sonar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform, pose_at
from tracking_core.platform_pose import PlatformPose
from tracking_tools.bags import MAX_ROWS
from tracking_tools.own_ship import read_platform
from tracking_tools.replay_topics import Topics
from tracking_tools.scene import choose, frame_of, read_rows, since, table_rows
from tracking_tools.track_table import check_table


@dataclass(frozen=True)
class BearingScene:
    """Rows of all messages; `time` counts from the beginning of the recording [s]."""

    marks: Columns  # time, bearing in tracking axes [rad], snr [dB]
    tracks: Columns  # confirmed tracks, a row per track and cycle
    truth: Columns  # id, time, bearing, range; empty without a truth
    own: Columns  # time, heading [rad]; empty without own ship
    begin: float = 0.0  # of the recording [s since the epoch]

    @property
    def has_truth(self) -> bool:
        """Whether the recording says what was really there."""
        return bool(len(self.truth.get('id', ())))


def read_bearing_scene(
    recording: Path | str,
    tracks: Path | str,
    topics: Topics,
    sensor: SensorConfig,
    fields: Mapping[str, str],
    truth: Path | str | None = None,
) -> BearingScene:
    """
    Return what the bags of marks and of tracks contain.

    Parameters
    ----------
    recording : Path or str
        Bag with marks, perhaps own ship and the truth.
    tracks : Path or str
        Bag with the track tables.
    topics : Topics
        Where the messages are.
    sensor : SensorConfig
        Conventions of the marks.
    fields : mapping
        Our names of their fields to those of the messages.
    truth : Path or str, optional
        Bag with the truth, if it is not that of the marks.

    """
    platform = read_platform(recording, topics.ownship)
    marks = read_rows(recording, topics.plots, lambda msg: _marks(msg, sensor, fields))
    # Marks in the frame of own ship's odometry are true bearings, and those that are said to be.
    turned = sensor.azimuth_reference == 'frame' and (
        frame_of(recording, topics.plots) != frame_of(recording, topics.ownship)
    )
    if len(marks.get('time', ())) and platform is not None and turned:
        heading = pose_at(platform, marks['time']).yaw + sensor.mount.yaw
        marks = {**marks, 'bearing': wrap_angle(marks['bearing'] + heading)}
    where, seer = recording if truth is None else truth, platform
    if truth is not None:  # it is seen from the ship that is told beside it
        seer = read_platform(truth, topics.ownship) or platform
    real = _seen_from(seer, read_rows(where, topics.truth, table_rows))
    table = read_rows(tracks, topics.tracks, table_rows)
    check_table(table, 'sonar', f'{topics.tracks} in {tracks}')
    own: Columns = {} if platform is None else _own(platform)
    times = [part['time'] for part in (marks, table) if len(part.get('time', ()))]
    begin = float(min(time.min() for time in times)) if times else 0.0
    marks, table, real, own = (since(begin, part) for part in (marks, table, real, own))
    confirmed = table.get('status', np.zeros(0)) == CONFIRMED
    return BearingScene(marks, choose(table, confirmed), real, own, begin)


def _marks(msg: Any, sensor: SensorConfig, fields: Mapping[str, str]) -> Columns:
    """Return a message's marks in sensor axes; of a bad message nothing."""
    try:
        marks = to_bearings(msg, sensor, MAX_ROWS, fields).plots
    except BadMessage:
        return {'time': np.zeros(0)}
    return {'time': marks.time, 'bearing': marks.bearing, 'snr': marks.snr}


def _seen_from(platform: Platform | None, truth: Columns) -> Columns:
    """Return the truth as bearing and range from own ship."""
    if not len(truth.get('id', ())):
        return {}
    pose: PlatformPose = pose_at(platform, truth['time'])
    x, y = truth['x'] - pose.position[:, 0], truth['y'] - pose.position[:, 1]
    there = {'bearing': np.arctan2(y, x), 'range': np.hypot(x, y)}
    return {'id': truth['id'], 'time': truth['time'], **there}


def _own(platform: Platform) -> Columns:
    heading: Floats = platform.at(platform.time).yaw
    return {'time': platform.time, 'heading': heading}
