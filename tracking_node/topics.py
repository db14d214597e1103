# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a node listens to and says while it is configured; messages go to the session."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import UInt32
from std_srvs.srv import Trigger

from msg_adapters.kinds.menu import message_class
from msg_adapters.message_types import rclpy_types
from tracking_node.body_topics import BodyTopics
from tracking_node.clock_check import ClockCheck
from tracking_node.clocks import age, arrival_time, Pausing
from tracking_node.display import MarkerTopic
from tracking_node.inputs import Inputs
from tracking_node.openings import Openings
from tracking_node.reporter import Reporter
from tracking_session.node_config import Configs
from tracking_session.orders import acquire, cancel
from tracking_session.session import Session
from tracking_session.snapshots.keeper import Keeper
from tracking_session.waiting import Came, Waiting

MakeSession = Callable[..., Session]

RETRY = 0.02  # s between two looks at plots that wait


class LiveTopics:
    """
    The topics of one tracker.

    Parameters
    ----------
    node : LifecycleNode
        Whose topics they are.
    make_session : callable
        Returns the session, from the configs, message classes and a log.
    configs : tuple
        Of the tracker and of the node.

    """

    def __init__(self, node: Any, make_session: MakeSession, configs: Configs) -> None:
        self._node, self._node_config, self._types = node, configs[1], rclpy_types()
        self._session = make_session(*configs, self._types, node.get_logger())
        self._topic = self._session.instrument.topic
        self._keeper = Keeper(self._session, configs, node.get_fully_qualified_name())
        self._clock_check, self._is_active = ClockCheck(node, self._topic), False
        self._openings = Openings(node)
        try:
            self._open(self._openings, message_class(configs[1].input_type))
        except Exception:
            self._openings.close()
            raise

    def _open(self, openings: Openings, input_class: Any) -> None:
        hear, tell = openings.hear, openings.tell
        subscriptions = {  # of two that are there, the executor takes the first
            'ownship': hear(Odometry, 'ownship', self._on_ownship),
            self._topic: hear(input_class, self._topic, self._on_plots),
            'acquire': hear(PointStamped, 'acquire', self._order('acquire', acquire)),
            'cancel': hear(UInt32, 'cancel', self._order('cancel', cancel)),
        }
        self._inputs = Inputs(subscriptions, self._session.ledger)
        self._tracks = tell(PointCloud2, '~/tracks')
        self._bodies = BodyTopics(openings, self._node_config.output_type, self._types)
        self._markers = MarkerTopic(openings, self._types)
        self._reporter = Reporter(self._node, self._session, self._types, openings)
        openings.serve(Trigger, '~/reset', self._on_reset)
        openings.every(1.0, self._tick)
        self._keeper.open(openings.every, arrival_time(self._node))
        self._waiting = Waiting(self._session, self._node_config, self._use_plots)
        self._time = Pausing(self._node)
        self._timer = openings.every(RETRY, self._retry)
        if self._node_config.use_tf:
            self._session.use_transforms(openings.transforms())
        session = self._session
        for take_note in (
            self._waiting.release, session.guard.clock_moved, session.whereabouts.clock_moved
        ):  # fmt: skip
            openings.when_clock_goes_back(take_note)

    def close(self) -> None:
        """Give all topics back, and keep the tracks where that is wanted."""
        try:
            self._waiting.release()
        finally:
            self._keeper.save()
            self._openings.close()

    def activate(self) -> None:
        """Begin to track."""
        self._is_active = True
        self._reporter.begin()
        self._reporter.tell_state(True)

    def deactivate(self) -> None:
        """Stop listening and clear the screens; tracks are kept."""
        self._waiting.release()
        self._is_active = False
        self._markers.clear(self._session)
        self._reporter.tell_state(False)

    def take_leave(self) -> None:
        """Clear the screens for good: who shows tracks has heard of it before the topics go."""
        self.deactivate()
        self._markers.take_leave()
        self._reporter.take_leave()

    def reconfigure(self, configs: Configs) -> None:
        """Go on with other live parameters."""
        config, self._node_config = configs
        self._session.instrument.tracker.reconfigure(config)

    def _on_plots(self, msg: Any, info: Any) -> None:
        if not self._is_active:
            self._inputs.ignore(self._topic, info)
            self._reporter.explain_idleness()
            return
        msg, info = self._inputs.freshest(self._topic, (msg, info), self._node_config.max_delay)
        for odometry in self._inputs.take_waiting('ownship'):  # known at the plots' time
            self._on_ownship(*odometry)
        self._reporter.plots_come()
        self._clock_check.compare(msg.header.stamp)
        self._waiting.plots(msg, arrival_time(self._node), info)
        if self._waiting and self._timer.is_canceled():
            self._timer.reset()

    def _retry(self) -> None:
        """Look at what waits, now and then: what it waits for may not come."""
        self._waiting.retry(self._time.now())
        if not self._waiting:
            self._timer.cancel()

    def _use_plots(self, came: Came, patience: float) -> None:
        health = self._reporter.health
        health.step_begins()
        table = self._session.plots(came.msg, came.received, patience)
        self._keeper.reserve_ids()
        if not self._node.context.ok():  # the node ends, and nobody hears of it
            return
        if table is not None:
            self._tracks.publish(table)
            self._show()
            health.latency = age(came.info)
        health.step_ends()
        self._reporter.report(self._is_active)

    def _show(self) -> None:
        """Publish what is for eyes and other tools, while somebody subscribes."""
        self._session.instrument.follow()
        self._bodies.publish(self._session.instrument, self._session.header())
        self._markers.follow(self._session, self._node_config.markers)

    def _on_ownship(self, msg: Any, info: Any) -> None:
        if not self._is_active:
            self._inputs.ignore('ownship', info)
        else:
            self._inputs.count('ownship', info)
            self._reporter.health.ownship_at = time.monotonic()
            self._waiting.ownship(msg, arrival_time(self._node))

    def _order(
        self, topic: str, give: Callable[[Session, Any], None]
    ) -> Callable[[Any, Any], None]:
        """Return a callback that hands orders on while the node is active."""

        def on_order(msg: Any, info: Any) -> None:
            if not self._is_active:
                self._inputs.ignore(topic, info)
                return
            self._inputs.count(topic, info)
            give(self._session, msg)

        return on_order

    def _on_reset(self, _: Any, response: Any) -> Any:
        self._waiting.clear()
        self._markers.clear(self._session)
        self._session.reset()
        self._keeper.save()
        response.success, response.message = True, 'all tracks are forgotten'
        self._node.get_logger().info('reset: all tracks are forgotten')
        return response

    def _tick(self) -> None:
        """Once a second: draw what was not due before, and report."""
        self._markers.draw(self._session, self._node_config.markers)
        self._reporter.tick(self._inputs.subscriptions, self._tracks, self._is_active)
