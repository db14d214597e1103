# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where the sensor is, from tf2: imported only where a user asks for it."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from tracking_core.batches import Floats
from tracking_core.platform import Platform
from tracking_node.clocks import to_duration, to_time
from tracking_session.whereabouts import NotYet

STEP = 0.1  # s at most between transforms that are asked for; meanwhile platforms turn evenly
KEPT = 60  # s that tf2 remembers: longer than any antenna turns
LEAD = 0.2  # s before the first plot that one more is asked for, to know how fast it moves


class TfTransforms:
    """
    The transforms that tf2 hears of.

    Parameters
    ----------
    node : Node
        That listens to /tf and /tf_static.

    Raises
    ------
    ValueError
        Where tf2_ros is not installed.

    """

    def __init__(self, node: Any) -> None:
        try:
            self._tf2 = import_module('tf2_ros')
        except ImportError as error:
            raise ValueError(
                'use_tf is true, but tf2_ros is not installed (ros-$ROS_DISTRO-tf2-ros-py); '
                'without it, give own ship on the topic ownship and the place of the sensor as '
                'sensor.mount.*'
            ) from error
        # Its own watch for a clock that goes back is left out: stamps count here, not the clock.
        self._buffer = self._tf2.Buffer(cache_time=to_duration(KEPT))
        self._newest = -np.inf  # moment that was told of [s]
        self._listener = self._tf2.TransformListener(self._buffer, node)

    def close(self) -> None:
        """Stop listening."""
        self._listener.unregister()

    def sensor(self, frame: str, into: str, times: Floats) -> Platform:
        """Return where a frame was, at a few moments; raises NotYet."""
        first, last = float(times.min()), float(times.max())
        if last < self._newest - KEPT:  # a bag that begins anew: tf2 would not hear of old times
            self._buffer.clear()
            self._newest = last
        wanted = np.unique(np.linspace(first, last, 2 + int((last - first) / STEP)))
        try:  # the last one first, for which plots wait
            rows = [self._look(into, frame, time) for time in wanted[::-1]][::-1]
        except self._tf2.TransformException as error:
            raise NotYet(f"no transform from '{frame}' to '{into}': {error}") from error
        self._newest = max(self._newest, last)
        try:
            wanted = np.insert(wanted, 0, first - LEAD)
            rows.insert(0, self._look(into, frame, float(wanted[0])))
        except self._tf2.TransformException:  # tf2 began to listen a moment ago: taken as at rest
            wanted = wanted[1:]
        return _platform(wanted, np.array(rows))

    def _look(self, into: str, frame: str, time: float) -> tuple[float, ...]:
        told = self._buffer.lookup_transform(into, frame, to_time(time)).transform
        p, q = told.translation, told.rotation
        return p.x, p.y, p.z, q.x, q.y, q.z, q.w


def _platform(time: Floats, rows: Floats) -> Platform:
    """Return samples from positions and orientations (K, 7), moving evenly between them."""
    K, position = len(time), rows[:, :3]
    moves = K > 1
    return Platform(
        time=time,
        position=position,
        orientation=rows[:, 3:],
        velocity=np.gradient(position, time, axis=0) if moves else np.zeros((K, 3)),
        position_covariance=np.zeros((K, 3, 3)),
        yaw_variance=np.zeros(K),
    )
