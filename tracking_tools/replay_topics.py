# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which topic of a bag is which of the node's, and what the node does with its messages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from rosbags.highlevel import AnyReader
from rosbags.interfaces import Connection

from msg_adapters.kinds.menu import check_type
from tracking_session.orders import acquire, cancel
from tracking_session.session import Session
from tracking_session.waiting import Waiting
from tracking_tools.bags import absolute, BadBag
from tracking_tools.sensors import SensorKind, SENSORS

DIAGNOSTICS, DIAGNOSTIC_ARRAY = '/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray'
TYPES = {
    'ownship': 'nav_msgs/msg/Odometry',
    'acquire': 'geometry_msgs/msg/PointStamped',
    'cancel': 'std_msgs/msg/UInt32',
}


class Handler(NamedTuple):
    """What becomes of the messages of one topic."""

    name: str  # ours
    take: Callable[[Any, float], Any]  # message and when it came [s]


@dataclass(frozen=True)
class Topics:
    """Names in the bags; those of the radar node by default."""

    plots: str = '/plots'  # of a sonar: its marks
    ownship: str = '/ownship'
    acquire: str = '/acquire'
    cancel: str = '/cancel'
    tracks: str = '/radar_tracker/tracks'
    truth: str = '/truth'
    node: str = '/radar_tracker'
    sensor: str = 'plots'  # what rules and counts call the first one

    @staticmethod
    def of(sensor: SensorKind) -> Topics:
        """Return the names that this sensor's node has."""
        node = f'/{sensor.node}'
        return Topics(f'/{sensor.topic}', tracks=f'{node}/tracks', node=node, sensor=sensor.topic)

    @staticmethod
    def remapped(rules: Iterable[str], sensor: SensorKind = SENSORS['radar']) -> Topics:
        """
        Return the topics under rules as ROS has them, ``plots:=/radar/plots``.

        Raises
        ------
        BadBag
            For a rule of another form or for a topic that there is none of.

        """
        topics = Topics.of(sensor)
        others = [name for name in vars(topics) if name not in ('plots', 'node', 'sensor')]
        known = {sensor.topic: 'plots', **{name: name for name in others}}
        for rule in rules:
            left, sign, theirs = rule.partition(':=')
            name = left.removeprefix('~').strip('/').removeprefix(f'{sensor.node}/')
            if not sign or not theirs.strip('/') or name not in known:
                raise BadBag(
                    f'--remap takes FROM:=TO with FROM one of {", ".join(known)}, got {rule!r}'
                )
            topics = replace(topics, **{known[name]: absolute(theirs)})
        return topics

    def handlers(self, session: Session, waiting: Waiting) -> dict[str, Handler]:
        """Return what to do with the messages of each topic; BadBag where tracks would go."""
        takes: dict[str, Callable[[Any, float], Any]] = {
            'plots': waiting.plots,
            'ownship': waiting.ownship,
            'acquire': lambda msg, _: acquire(session, msg),
            'cancel': lambda msg, _: cancel(session, msg),
        }
        names = {'plots': self.sensor}
        found = {
            getattr(self, name): Handler(names.get(name, name), take)
            for name, take in takes.items()
        }
        if self.tracks in found:
            raise BadBag(f'{self.tracks} is for {found[self.tracks].name}, tracks cannot go there')
        return found


def check_topics(bag: AnyReader, topics: Topics, path: Path | str) -> None:
    """Raise BadBag unless the bag has plots, and every topic that we read is of its type."""
    there = {connection.topic: connection.msgtype for connection in bag.connections}
    has = inventory(bag)
    if topics.plots not in there:
        raise BadBag(
            f'{path} has no topic {topics.plots}; it has {has}. '
            f'Say which are the {topics.sensor} with --remap {topics.sensor}:=/TOPIC'
        )
    try:
        check_type(there[topics.plots])
    except ValueError as error:
        raise BadBag(
            f'{path}: {topics.plots} is {there[topics.plots]}, expected '
            f'sensor_msgs/msg/PointCloud2 or another type of plots: {error}; it has {has}'
        ) from error
    for name in TYPES:
        check_type_of(name, bag, topics, path)


def check_type_of(name: str, bag: AnyReader, topics: Topics, path: Path | str) -> None:
    """Raise BadBag where one of our topics beside the plots is there with another type."""
    topic, expected = getattr(topics, name), TYPES[name]
    for connection in bag.connections:
        if connection.topic == topic and connection.msgtype != expected:
            raise BadBag(
                f'{path}: {topic} is {connection.msgtype}, expected {expected}; '
                f'it has {inventory(bag)}'
            )


def check_named(
    bag: AnyReader, topics: Topics, path: Path | str, names: Iterable[str] = TYPES
) -> None:
    """Raise BadBag where a rule leads one of our names to a topic that the bag does not have."""
    there = {connection.topic for connection in bag.connections}
    for name in names:
        topic = getattr(topics, name)
        if topic != getattr(Topics, name) and topic not in there:
            raise BadBag(
                f'{path} has no topic {topic}, to which {name} is remapped; '
                f'it has {inventory(bag)}'
            )


def inventory(bag: AnyReader) -> str:
    """Return what a bag has, for people."""
    names = sorted({connection.topic for connection in bag.connections})
    parts = [f'{n} ({bag.topics[n].msgtype}, {bag.topics[n].msgcount} messages)' for n in names]
    return ', '.join(parts) or 'no topics'


def messages_of(
    bag: AnyReader, chosen: Sequence[Connection]
) -> Iterator[tuple[Connection, int, bytes]]:
    """Yield connection, time [ns] and bytes of each message; BadBag where the file is damaged."""
    messages, count = bag.messages(chosen), 0
    promised = sum(connection.msgcount for connection in chosen)
    while True:
        try:
            message = next(messages)
        except StopIteration:
            break
        except Exception as error:  # whatever damaged bytes lead the reader to
            raise BadBag(f'damaged after {count} messages: {error}') from error
        yield message
        count += 1
    if count < promised:
        raise BadBag(f'damaged: {count} of {promised} messages can be read')
