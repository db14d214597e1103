# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a scene goes on the air, whoever sees or hears it: topics, pace and messages."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from msg_adapters.message_types import MessageTypes
from tracking_tools.scenarios.listening import BEARINGS, listen, OWNSHIP, Watch
from tracking_tools.scenarios.messages import PLOTS, send, Sent, TRUTH
from tracking_tools.scenarios.plots import Scenario

Scene = Scenario | Watch
TABLE, ODOMETRY = 'sensor_msgs/msg/PointCloud2', 'nav_msgs/msg/Odometry'


@dataclass(frozen=True)
class Broadcast:
    """What a sensor sends, and when."""

    sensor: str
    """As in `tracking_tools.sensors.SENSORS`."""
    topic: str
    """Where a tracker listens for plots."""
    types: Mapping[str, str]
    """Of the messages on each topic."""
    period: float
    """From one list of messages to the next [s]."""
    count: int
    """Of the lists."""
    messages: Callable[[MessageTypes, float], Iterator[list[Sent]]]
    """Makes them, of these classes and from this stamp on [s since the epoch]."""


def broadcast(scene: Scene, sectors: int = 1) -> Broadcast:
    """
    Return how a radar sends its scenario, or a sonar its watch.

    Parameters
    ----------
    scene : Scenario or Watch
        What happens.
    sectors : int
        Messages in a turn of a radar.

    Raises
    ------
    ValueError
        For sectors of a sonar; those of a radar are checked as it sends.

    """
    if isinstance(scene, Watch):
        if sectors != 1:
            raise ValueError(f'sectors must be 1 for a sonar, got {sectors}')
        types = {OWNSHIP: ODOMETRY, BEARINGS: TABLE, TRUTH: TABLE}
        period, cycles = scene.array.period, len(scene.times)
        return Broadcast('sonar', BEARINGS, types, period, cycles, partial(listen, scene))
    radar = scene.radar
    return Broadcast(
        sensor='radar',
        topic=PLOTS,
        types={PLOTS: TABLE, TRUTH: TABLE},
        period=radar.period / max(sectors, 1),
        count=sectors * radar.turns(scene.duration),
        messages=lambda types, epoch: send(scene, types, sectors, epoch),
    )
