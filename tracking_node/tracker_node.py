# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
A tracker as a ROS node: its parameters and its lifecycle.

Topics are in ``topics.py``, what happens to a message in ``tracking_session/session.py``.
"""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn

from msg_adapters.kinds.menu import available
from msg_adapters.radar_tracks import available as outputs
from tracking_node.parameters import NodeParameters
from tracking_node.run import NotStarted
from tracking_node.topics import LiveTopics, MakeSession
from tracking_node.transitions import refuse_wrong_transitions, reported
from tracking_session.node_config import Configs, TELLING


class TrackerNode(LifecycleNode):
    """
    Plots of one sensor to tracks.

    Subscribes to the sensor's topic (PointCloud2 or another `input_type`), `ownship` (Odometry),
    `acquire` (PointStamped) and `cancel` (UInt32); publishes `~/tracks` (PointCloud2),
    `~/odometry` (Odometry), `~/markers` (MarkerArray), `~/radar_tracks` (RadarTracks, if
    `output_type` says so) and `/diagnostics`;
    serves `~/reset` (Trigger).

    Parameters
    ----------
    name : str
        Of the node.
    configs : tuple
        Defaults of the parameters: those of the tracker, then those of the node.
    make_session : callable
        Returns what the messages are handed to.

    """

    def __init__(self, name: str, configs: Configs, make_session: MakeSession) -> None:
        super().__init__(name)
        refuse_wrong_transitions(self)
        self._make_session = make_session
        self._live: LiveTopics | None = None
        self._settings = NodeParameters(self, configs, self._reconfigure)
        self._settings.tell()
        for told, values in zip(TELLING, (available(), outputs()), strict=True):
            self._tell(told, values)
        _, node_config = self._settings.configs
        if node_config.autostart:
            self._start()
        else:
            way = f'ros2 lifecycle set {self.get_fully_qualified_name()} configure'
            self._settings.logger.info(f'autostart is false: waits for a manager, or {way}')

    def _tell(self, name: str, values: list[str]) -> None:
        """Declare a parameter that only says something."""
        self.declare_parameter(
            name, values or ['none'], ignore_override=True,
            descriptor=ParameterDescriptor(description=TELLING[name], read_only=True),
        )  # fmt: skip

    def _start(self) -> None:
        steps: tuple[Any, ...] = (self.trigger_configure, self.trigger_activate)
        for step in steps:
            if step() != TransitionCallbackReturn.SUCCESS:
                raise NotStarted('the node could not be configured and activated')

    def _reconfigure(self, configs: Configs) -> None:
        if self._live is not None:
            self._live.reconfigure(configs)

    @reported
    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Make the tracker and open all topics."""
        try:
            self._live = LiveTopics(self, self._make_session, self._settings.configs)
            self._settings.tell_idle_overrides(self)
        except (ValueError, RuntimeError) as error:  # what fits alone but not together, a bad QoS
            if self.context.ok():  # else it is just a signal that came meanwhile
                self._settings.logger.fatal(f'cannot be configured: {error}')
            return TransitionCallbackReturn.FAILURE
        return super().on_configure(state)

    @reported
    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to track."""
        if self._live is not None:
            self._live.activate()
        return super().on_activate(state)

    @reported
    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop listening; tracks are kept."""
        if self._live is not None:
            self._live.deactivate()
        return super().on_deactivate(state)

    @reported
    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget everything."""
        self._close()
        return super().on_cleanup(state)

    @reported
    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget everything, for good; the screens are cleared where it was active."""
        if self._live is not None:
            self._live.take_leave()
        self._close()
        return super().on_shutdown(state)

    @reported
    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget everything after a step that failed, and be as before it was configured."""
        self._close()
        return super().on_error(state)

    def destroy_node(self) -> None:
        """Keep the tracks where that is wanted, also when no transition came before."""
        self._close()
        super().destroy_node()

    def _close(self) -> None:
        live, self._live = self._live, None
        if live is not None:
            live.close()
