# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots wait, in order and for a bounded time, until it is known where their sensor was."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from msg_adapters.message_types import seconds
from tracking_session.node_config import NodeConfig
from tracking_session.session import Session
from tracking_session.whereabouts import NotYet

MOST, ROOM = 200, 50_000_000  # messages, and bytes of them; then the oldest waits no longer


class Came(NamedTuple):
    """A message with plots."""

    msg: Any
    received: float  # by a clock that never goes back [s]
    info: Any  # what else is known of it

    @property
    def size(self) -> int:
        """How many bytes of rows it has."""
        return len(getattr(self.msg, 'data', ()))


class Waiting:
    """
    A queue before a session that is empty unless somebody must wait.

    A node and a replay hand plots and odometry over to it as they came, so both wait alike.

    Parameters
    ----------
    session : Session
        Of the messages.
    config : NodeConfig
        How long plots may wait: ``ownship_patience``, or ``tf_patience`` with ``use_tf``.
    use : callable
        Takes a message and what `Session.plots` takes as patience; lets NotYet pass.

    """

    def __init__(
        self, session: Session, config: NodeConfig, use: Callable[[Came, float], object]
    ) -> None:
        self._session, self._use = session, use
        self._patience = config.tf_patience if config.use_tf else config.ownship_patience
        self._queue: deque[Came] = deque()
        self._held = 0  # bytes
        self._wanted = -np.inf  # time of own ship that the first one waits for [s]

    def __len__(self) -> int:
        return len(self._queue)

    def plots(self, msg: Any, received: float, info: Any = None) -> None:
        """Use plots, after those that wait; arguments as of `Session.plots`."""
        self._queue.append(Came(msg, received, info))
        self._held += self._queue[-1].size
        self.retry(received)

    def ownship(self, msg: Any, received: float) -> None:
        """Take one odometry, and use the plots that have waited for it."""
        if self._queue and not self._session.whereabouts.goes_on(seconds(msg.header.stamp)):
            self.release()  # they are of the time before
        self._session.ownship(msg, received)
        self.retry(received)

    def retry(self, now: float) -> None:
        """Use those that can be used now [s], or have waited for too long."""
        count = self._session.counts[self._session.instrument.topic]
        while self._queue:
            waited = now - self._queue[0].received
            if self._wanted > self._session.whereabouts.newest and not self._is_over(now):
                return
            came, count.wait = self._pop(), waited
            try:
                self._use(came, self._patience)
            except NotYet as reason:
                self._queue.appendleft(came)
                self._held, self._wanted = self._held + came.size, reason.wanted
                if not self._is_over(now):
                    return
                self._tell_in_vain(waited)
                self._use(self._pop(), 0.0)

    def _is_over(self, now: float) -> bool:
        """Return whether the first one may wait no longer."""
        waited, is_full = now - self._queue[0].received, len(self._queue) > MOST
        is_late = is_full or self._held > ROOM or not 0.0 <= waited <= self._patience
        return is_late or self._session.whereabouts.is_silent(now, self._patience)

    def _tell_in_vain(self, waited: float) -> None:
        session, topic = self._session, self._session.instrument.topic
        # Without a transform the message will be refused, and told.
        if waited > 0.0 and session.whereabouts.transforms is None:
            session.counts[topic].in_vain += 1
            session.ledger.warn(
                'in vain',
                f'{topic} have waited {waited:.2g} s in vain for odometry of their time '
                '(ownship_patience): they are placed as if own ship had gone on as it moved',
            )

    def release(self) -> None:
        """Use all that wait, now."""
        while self._queue:
            self._use(self._pop(), 0.0)

    def _pop(self) -> Came:
        came = self._queue.popleft()
        self._held, self._wanted = self._held - came.size, -np.inf
        return came

    def clear(self) -> None:
        """Forget all that wait."""
        self._queue.clear()
        self._held, self._wanted = 0, -np.inf
