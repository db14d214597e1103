# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which messages a ship with a passive array sends: marks, its own odometry, and the truth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
import math
from typing import Any

import numpy as np

from msg_adapters import table
from msg_adapters.message_types import MessageTypes
from tracking_core.batches import Bools, Floats
from tracking_tools.scenarios.array import LinearArray
from tracking_tools.scenarios.messages import as_table, EPOCH, Sent, TRUTH
from tracking_tools.scenarios.passes import Contact, TrueStates
from tracking_tools.scenarios.trajectory import Trajectory

BEARINGS, OWNSHIP = 'bearings', 'ownship'
MAP, ARRAY, SHIP = 'map', 'array', 'base_link'  # frames


@dataclass(frozen=True)
class Watch:
    """A ship that listens with an array along its axis."""

    own: Trajectory
    contacts: tuple[Contact, ...]
    levels: tuple[float, ...]
    """Of the contacts [dB]."""
    duration: float
    """[s]."""
    description: str
    array: LinearArray = field(default_factory=LinearArray)
    seed: int = 1

    def __post_init__(self) -> None:
        if not self.duration > 0.0:
            raise ValueError(f'Watch.duration must be above 0 s, got {self.duration}')

    @property
    def times(self) -> Floats:
        """Of the cycles (K,) [s]."""
        return np.arange(0.0, self.duration, self.array.period)


def listen(watch: Watch, types: MessageTypes, epoch: float = EPOCH) -> Iterator[list[Sent]]:
    """
    Yield the messages of each cycle: own ship, the marks, the truth.

    Bearings of marks are clockwise from ahead, as far as an array can tell: those of contacts to
    port and starboard are the same. Levels are in dB over the noise of a beam.
    """
    rng, time, array = np.random.default_rng(watch.seed), watch.times, watch.array
    place, velocity = watch.own.at(time)
    course = np.arctan2(velocity[:, 1], velocity[:, 0])
    states = [contact.trajectory.at(time) for contact in watch.contacts]
    line = np.stack([position - place for position, _ in states], axis=1)  # (K, C, 3)
    bearing = array.from_axis(np.arctan2(line[..., 1], line[..., 0]) - course[:, None])
    heights = array.heights(np.hypot(line[..., 0], line[..., 1]), np.array(watch.levels), rng)
    output = array.listen(array.lobes(bearing), heights * _is_there(watch), rng)
    marks = _marks(array, output)
    for k, now in enumerate(time):
        header = types.header(epoch + now, MAP)
        yield [
            Sent(OWNSHIP, _odometry(place[k], velocity[k], header, types), now),
            Sent(BEARINGS, table.from_columns(marks[k], epoch + now, ARRAY, types), now),
            Sent(TRUTH, _truth(watch, states, k, epoch, types), now),
        ]


def _is_there(watch: Watch) -> Bools:
    """Return whether each contact can be heard in each cycle (K, C)."""
    spans = np.array([(contact.appear, contact.disappear) for contact in watch.contacts])
    time = watch.times[:, None]
    return np.asarray((time >= spans[:, 0]) & (time < spans[:, 1]))


def _marks(array: LinearArray, output: Floats) -> list[dict[str, Any]]:
    """Return the columns of each cycle's marks."""
    cycle, bearing, snr = array.marks(output)
    columns = {
        'bearing': bearing,
        'bearing_sd': array.reported_sd(bearing, snr),
        'snr': 10.0 * np.log10(snr),
    }
    edges = np.searchsorted(cycle, np.arange(len(output) + 1))
    return [
        {name: column[start:end].astype(np.float32) for name, column in columns.items()}
        for start, end in pairwise(edges)
    ]


def _truth(watch: Watch, states: list[Any], k: int, epoch: float, types: MessageTypes) -> Any:
    now, there = watch.times[k], np.flatnonzero(_is_there(watch)[k])
    ids = np.array([watch.contacts[i].id for i in there], np.int64)
    rows = TrueStates(
        id=ids,
        time=np.full(len(there), now),
        position=np.array([states[i][0][k] for i in there]).reshape(-1, 3),
        velocity=np.array([states[i][1][k] for i in there]).reshape(-1, 3),
    )
    return table.from_columns(as_table(rows.columns(), now), epoch + now, MAP, types)


def _odometry(place: Floats, velocity: Floats, header: Any, types: MessageTypes) -> Any:
    course, nothing = math.atan2(velocity[1], velocity[0]), types.Vector3(x=0.0, y=0.0, z=0.0)
    x, y, z = place.tolist()
    half, speed = 0.5 * course, math.hypot(velocity[0], velocity[1])
    return types.Odometry(
        header=header,
        child_frame_id=SHIP,
        pose=types.PoseWithCovariance(
            pose=types.Pose(
                position=types.Point(x=x, y=y, z=z),
                orientation=types.Quaternion(x=0.0, y=0.0, z=math.sin(half), w=math.cos(half)),
            ),
            covariance=np.zeros(36),
        ),
        twist=types.TwistWithCovariance(
            twist=types.Twist(linear=types.Vector3(x=speed, y=0.0, z=0.0), angular=nothing),
            covariance=np.zeros(36),
        ),
    )
