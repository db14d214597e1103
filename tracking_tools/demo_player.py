# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a recording is played to a live node, and what the node answers is recorded."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
import sys
import time
from typing import Any

from rosbags.highlevel import AnyReader
from tqdm import tqdm

from msg_adapters.kinds.menu import check_type
from msg_adapters.message_types import NANOSECONDS
from tracking_tools.bags import BagWriter, open_bag, POINT_CLOUD
from tracking_tools.node_process import NodeFailed, NodeProcess, private_domain, python_node
from tracking_tools.replay import RADAR
from tracking_tools.replay_topics import (
    check_named,
    check_topics,
    DIAGNOSTIC_ARRAY,
    DIAGNOSTICS,
    messages_of,
    Topics,
)
from tracking_tools.sensors import SensorKind


def play(
    recording: Path,
    tracks: Path,
    parameters: Path,
    rate: float,
    log: Path,
    sensor: SensorKind = RADAR,
    topics: Topics | None = None,
) -> None:
    """
    Play a recording to the live node and record its tracks.

    Parameters
    ----------
    recording : Path
        Bag with plots.
    tracks : Path
        Bag to make; messages have the times of the plots they answer.
    parameters : Path
        Parameter file of the node.
    rate : float
        Times real time, as far as the node keeps up.
    log : Path
        File for what the node says.
    sensor : SensorKind
        What the plots are from.
    topics : Topics, optional
        Where the messages are in the bags; the names that the node has by default.

    Raises
    ------
    NodeFailed
        If the node does not start, answer, or end as it should.

    """
    recorder = import_module('tracking_tools.recording')  # needs rclpy, the replay does not
    live = Topics.of(sensor)
    topics = topics or live
    with open_bag(recording) as bag, private_domain() as domain_id:
        check_topics(bag, topics, recording)
        check_named(bag, topics, recording)
        kind = check_type(bag.topics[topics.plots].msgtype or '')
        given = ('--params-file', str(parameters), '-p', f'input_type:={kind}')
        command = python_node(f'{sensor.node}.node', *given)
        print(f'{sensor.node}: starting in ROS domain {domain_id}, log in {log}', flush=True)
        node = NodeProcess(command, domain_id, log)
        own_ship = live.ownship if topics.ownship in bag.topics else ''
        with (
            node,
            recorder.open_player(
                live.plots, live.tracks, domain_id, node.check, own_ship, kind
            ) as player,
            BagWriter(tracks) as out,
        ):
            out.announce(topics.tracks, POINT_CLOUD)
            told = player.watch_health(DIAGNOSTICS)
            player.find_tracker()
            played = (topics.plots, topics.ownship)
            for topic, received, raw in _paced(bag, player.wait, rate, played):
                if topic == topics.ownship:
                    player.tell_own_ship(raw)
                    continue
                out.write_raw(topics.tracks, POINT_CLOUD, _answer(player, raw, log), received)
                while told:
                    out.write_raw(DIAGNOSTICS, DIAGNOSTIC_ARRAY, told.pop(0), received)
    if node.exit_code:
        raise NodeFailed(f'the node ended with code {node.exit_code}; see {log}')


def _answer(player: Any, raw: bytes, log: Path) -> bytes:
    try:
        return bytes(player.ask(raw))
    except TimeoutError as error:
        raise NodeFailed(f'the node did not answer: {error}; see {log}') from error


def _paced(
    bag: AnyReader, wait: Callable[[float], None], rate: float, topics: Sequence[str]
) -> Iterator[tuple[str, int, bytes]]:
    """Yield topic, time of recording [ns] and bytes of each message, each when it is due."""
    chosen = [connection for connection in bag.connections if connection.topic in topics]
    total = sum(c.msgcount for c in chosen if c.topic == topics[0])
    first, began = None, time.monotonic()
    shape = '{desc} {percentage:3.0f}% |{bar:40}| scan {n} of {total}, {remaining} left'
    with tqdm(
        total=total, desc='playing', bar_format=shape, mininterval=_interval(), file=sys.stdout
    ) as progress:
        for connection, received, raw in messages_of(bag, chosen):
            first = received if first is None else first
            wait(began + (received - first) / NANOSECONDS / rate)
            yield connection.topic, received, raw
            progress.update(connection.topic == topics[0])


def _interval() -> float:
    """Return how often to show progress [s]: seldom where every time is a new line."""
    return 0.1 if sys.stdout.isatty() else 5.0
