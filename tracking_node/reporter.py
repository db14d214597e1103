# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When does a node say how it does? On /diagnostics, and in the log where nothing comes in."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray

from msg_adapters.diagnostics import to_diagnostics
from msg_adapters.message_types import MessageTypes
from tracking_node.endpoints import wait_for_readers
from tracking_node.health import Health, QUIET
from tracking_node.openings import Openings
from tracking_node.silence import explain_crowd, explain_silence, Lasting, unheard
from tracking_session.session import Session

CROWDED = 30.0  # s that are worth a word: the graph knows of a node that was killed for 20 s


class Reporter:
    """
    Reports once a second, and at once when the level is another.

    Parameters
    ----------
    node : LifecycleNode
        Whose health it is.
    session : Session
        What happened to its messages.
    types : MessageTypes
        Classes of the messages.
    openings : Openings
        Of the node; they close the topic.

    """

    def __init__(
        self, node: Any, session: Session, types: MessageTypes, openings: Openings
    ) -> None:
        self._node, self._session, self._types = node, session, types
        self._diagnostics = openings.tell_always(DiagnosticArray, '/diagnostics')
        self._level = ''  # that was said last
        self.begin()

    def begin(self) -> None:
        """Begin anew, as the node does when it becomes active."""
        self.health, self._silence_is_told = Health(time.monotonic()), False
        self._idleness_is_told = False
        self._unheard, self._crowded = Lasting(), Lasting()
        self._explained, self._named = set[str](), set[str]()  # topics of these two

    def plots_come(self) -> None:
        """Take note that plots have just come."""
        self.health.plots_come(time.monotonic())
        self._silence_is_told = True

    def explain_idleness(self) -> None:
        """Say once that plots come to a node that is not active."""
        if not self._idleness_is_told:
            self._idleness_is_told = True
            name, topic = self._node.get_fully_qualified_name(), self._session.instrument.topic
            self._node.get_logger().info(
                f'{topic} come, but the node is not active: ros2 lifecycle set {name} activate'
            )

    def tell_state(self, is_active: bool) -> None:
        """Report at once that the node tracks from now on, or no more."""
        self._level = ''
        self.report(is_active)

    def take_leave(self) -> None:
        """Let readers have what was reported last before the topic goes."""
        wait_for_readers(self._diagnostics)

    def tick(self, subscriptions: Mapping[str, Any], tracks: Any, is_active: bool) -> None:
        """
        Report once a second.

        Parameters
        ----------
        subscriptions : mapping
            By topic; if nothing comes of the plots, or a publisher does not fit, the log says why.
        tracks : Publisher
            Nobody else should publish there; another node of the same name does.
        is_active : bool
            Whether the node tracks.

        """
        is_shared = self._node.count_publishers(tracks.topic_name) > 1
        self.health.shared = (tracks.topic_name,) if is_shared else ()
        if is_active:
            now = time.monotonic()
            self._explain(subscriptions, now)
            self._name_crowds(subscriptions, now)
        self._level = ''
        self.report(is_active)
        self.health.told(self._session)

    def _explain(self, subscriptions: Mapping[str, Any], now: float) -> None:
        """Say once of whom nothing comes, and why; of the plots also if nobody is there."""
        self._unheard.take(unheard(self._node, subscriptions), now)
        silent, topic = self._unheard.longer(QUIET, now), self._session.instrument.topic
        self.health.unheard = tuple(sorted(silent))
        new = silent - self._explained
        is_told = self._silence_is_told or topic in self._unheard.since
        if not is_told and now - self.health.started > QUIET:
            self._silence_is_told = True
            new.add(topic)
        for name in sorted(new):
            self._node.get_logger().warning(explain_silence(self._node, subscriptions[name]))
        self._explained = silent

    def _name_crowds(self, subscriptions: Mapping[str, Any], now: float) -> None:
        """Say once who publishes where one publisher is wanted."""
        self._crowded.take(self.health.crowded(self._session), now)
        crowded = self._crowded.longer(CROWDED, now)
        for name in sorted(crowded - self._named):
            topic = subscriptions[name].topic_name if name in subscriptions else name
            self._node.get_logger().warning(explain_crowd(self._node, topic))
        self._named = crowded

    def report(self, is_active: bool) -> None:
        """Publish the diagnostics if their level is not the one that was said last."""
        now, level, text = time.monotonic(), 'OK', 'not active'
        if is_active:
            level, text = self.health.level(self._session, now)
        if level == self._level:
            return
        self._level, values = level, self.health.values(self._session, now)
        name = f'{self._node.get_fully_qualified_name().lstrip("/")}: tracking'
        header = self._types.Header(stamp=self._node.get_clock().now().to_msg(), frame_id='')
        self._diagnostics.publish(
            to_diagnostics(name, level, text, values=values, header=header, types=self._types)
        )
