# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of the messages of a bag, in the order and at the times in which they came."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any, NamedTuple

from rosbags.highlevel import AnyReader
from tqdm import tqdm

from msg_adapters.message_types import NANOSECONDS
from tracking_core.batches import Tracks
from tracking_session.node_config import NodeConfig
from tracking_session.session import Session
from tracking_session.waiting import Came, Waiting
from tracking_tools.bags import UNREADABLE
from tracking_tools.replay_topics import messages_of, Topics


class Answer(NamedTuple):
    """What comes of one message with plots."""

    table: Any
    tracks: Tracks
    taken: float  # [s]


def drive(
    bag: AnyReader, session: Session, config: NodeConfig, topics: Topics, quiet: bool
) -> Iterator[tuple[Answer, int]]:
    """Yield each track table, and when what it needs had been recorded [ns]."""
    answers: list[Answer] = []

    def use(came: Came, patience: float) -> None:
        began = time.perf_counter()
        table = session.plots(came.msg, came.received, patience)
        if table is not None:
            answers.append(Answer(table, session.tracks, time.perf_counter() - began))

    waiting, received = Waiting(session, config, use), 0
    handlers = topics.handlers(session, waiting)
    chosen = [connection for connection in bag.connections if connection.topic in handlers]
    total = sum(connection.msgcount for connection in chosen)
    with tqdm(total=total, desc='replay', unit='msg', disable=quiet or None) as progress:
        for connection, received, raw in messages_of(bag, chosen):
            progress.update()
            waiting.retry(received / NANOSECONDS)
            ours = handlers[connection.topic]
            session.counts[ours.name].received(None, 1)
            try:
                msg = bag.deserialize(raw, connection.msgtype)
            except UNREADABLE:
                session.counts[ours.name].refused['not readable'] += 1
                continue
            ours.take(msg, received / NANOSECONDS)
            yield from ((answer, received) for answer in answers)
            answers.clear()
        waiting.release()
        yield from ((answer, received) for answer in answers)
