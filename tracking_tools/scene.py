# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording and its tracks show together: plots, tracks and the truth, if there is one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import frame_name, seconds
from msg_adapters.table import Columns, to_columns
from msg_adapters.track_rows import CONFIRMED
from radar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Bools, Floats, Ints
from tracking_tools.bags import MAX_ROWS, open_bag, UNREADABLE
from tracking_tools.own_ship import read_platform
from tracking_tools.plot_places import PlotPlaces
from tracking_tools.replay_topics import Topics
from tracking_tools.track_table import check_table


@dataclass(frozen=True)
class Scene:
    """
    Rows of all messages.

    `time` and `stamp`, that of the message, count from the beginning of the recording [s].
    """

    plots: Columns  # x, y, and sensor_x, sensor_y; empty where nobody can place them
    published: Columns  # confirmed tracks, a row per track and message
    truth: Columns  # id, x, y, z, vx, vy, vz, time; empty without a truth
    begin: float = 0.0  # of the recording [s since the epoch]

    @cached_property
    def tracks(self) -> Columns:
        """Confirmed tracks, a row per track and look: a message may come before the antenna."""
        if not self.published:
            return self.published
        key = np.stack([self.published['id'], self.published['time'].round(6)], axis=1)
        _, first = np.unique(key, axis=0, return_index=True)
        return choose(self.published, np.sort(first))

    @property
    def has_truth(self) -> bool:
        """Whether the recording says what was really there."""
        return bool(len(self.truth.get('id', ())))


def read_scene(
    recording: Path | str,
    tracks: Path | str,
    topics: Topics | None = None,
    sensor: SensorConfig | None = None,
    fields: Mapping[str, str] | None = None,
    truth: Path | str | None = None,
) -> Scene:
    """
    Return what the bags of plots and of tracks contain.

    Parameters
    ----------
    recording : Path or str
        Bag with plots and perhaps the truth.
    tracks : Path or str
        Bag with the track tables.
    topics : Topics, optional
        Where the messages are.
    sensor : SensorConfig, optional
        Conventions of the plots.
    fields : mapping, optional
        Our names of their fields to those of the messages.
    truth : Path or str, optional
        Bag with the truth, if it is not that of the plots.

    """
    topics, sensor = topics or Topics(), sensor or SensorConfig()
    frame = frame_of(tracks, topics.tracks)
    is_told = frame_of(recording, topics.ownship) == frame
    platform = read_platform(recording, topics.ownship) if is_told else None
    plots = read_rows(
        recording, topics.plots, PlotPlaces(sensor, fields or {}, platform, frame).of
    )
    real = read_rows(recording if truth is None else truth, topics.truth, table_rows)
    table = read_rows(tracks, topics.tracks, table_rows)
    check_table(table, 'radar', f'{topics.tracks} in {tracks}')
    timed = [part['time'] for part in (plots, table) if len(part.get('time', ()))]
    begin = float(min(times.min() for times in timed)) if timed else 0.0
    plots, table, real = (since(begin, part) for part in (plots, table, real))
    confirmed = table.get('status', np.zeros(0)) == CONFIRMED
    return Scene(plots=plots, published=choose(table, confirmed), truth=real, begin=begin)


def choose(columns: Columns, rows: Bools | Ints | slice) -> Columns:
    """Return these rows of every column."""
    return {name: values[rows] for name, values in columns.items()}


def of_id(columns: Columns, number: int) -> Columns:
    """Return the rows of one track or contact."""
    return choose(columns, columns['id'] == number)


def turn_rate(path: Columns) -> Floats:
    """Return how fast a path's course turns at its rows [rad/s], anticlockwise; 0 if not told."""
    if len(path['time']) < 2 or not {'vx', 'vy'} <= path.keys():
        return np.zeros(len(path['time']))
    course = np.unwrap(np.arctan2(path['vy'], path['vx']))
    return np.asarray(np.gradient(course, path['time']))


def read_rows(path: Path | str, topic: str, convert: Callable[[Any], Columns]) -> Columns:
    """Return the rows of all messages on a topic that can be read; empty if there is none."""
    tables: list[Columns] = []
    with open_bag(path) as bag:
        chosen = [connection for connection in bag.connections if connection.topic == topic]
        if not chosen:
            return {}
        for connection, _, raw in bag.messages(chosen):
            try:
                columns = convert(bag.deserialize(raw, connection.msgtype))
            except (BadMessage, *UNREADABLE):
                continue  # replay counts them
            if len(columns['time']):
                tables.append(columns)
    common = set.intersection(*(set(table) for table in tables)) if tables else set()
    return {name: np.concatenate([table[name] for table in tables]) for name in sorted(common)}


def frame_of(path: Path | str, topic: str) -> str:
    """Return the frame of the first message on a topic, '' without one."""
    with open_bag(path) as bag:
        chosen = [connection for connection in bag.connections if connection.topic == topic]
        for connection, _, raw in bag.messages(chosen) if chosen else ():
            msg: Any = bag.deserialize(raw, connection.msgtype)
            return frame_name(msg.header.frame_id)
    return ''


def table_rows(msg: Any) -> Columns:
    """Return the columns of a table, with the time of each row and of the message [s]."""
    if not hasattr(msg, 'point_step'):
        raise BadMessage('another type', f'a {type(msg).__name__} is no table')
    columns = to_columns(msg, MAX_ROWS)
    offset = columns.get('time', np.zeros(msg.width * msg.height))
    stamp = np.full(len(offset), seconds(msg.header.stamp))
    return {**columns, 'time': stamp + offset.astype(np.float64), 'stamp': stamp}


def since(begin: float, part: Columns) -> Columns:
    """Return the rows with times that count from the beginning [s]."""
    times: Columns = {name: part[name] - begin for name in ('time', 'stamp') if name in part}
    return {**part, **times}
