# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A node that sends plots to a tracker, and keeps the tracks and diagnostics that come back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
import numpy as np
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger

from msg_adapters.message_types import rclpy_types, seconds
from msg_adapters.table import Columns, from_columns, to_columns
from msg_adapters.track_rows import CONFIRMED
from tracking_tools.node_process import DEADLINE
from tracking_tools.peer import AGAIN, Peer
from tracking_tools.testing.synthetic import RADAR, START, SyntheticSensor

MAX_ROWS = 100_000  # of a track table
SAME = 1e-6  # difference of two equal stamps [s]
GREETING = 0.1  # between two empty scans of a probe that nobody has answered yet [s]


def confirmed_ids(table: Columns) -> set[int]:
    """Return the ids of the confirmed tracks in a track table."""
    return set(table['id'][table['status'] == CONFIRMED].tolist())


class TrackerProbe:
    """
    A sensor and a listener in one, in the graph of a tracker.

    Publisher: the sensor's topic (PointCloud2).
    Subscribers: the tracks of the sensor's node (PointCloud2), /diagnostics (DiagnosticArray).

    Parameters
    ----------
    domain_id : int
        ROS domain.
    sensor : SyntheticSensor
        What to send, and to whom.
    namespace : str
        Of the tracker and its topics.
    check : callable, optional
        Raises when waiting has become useless, such as `NodeProcess.check`.

    """

    def __init__(
        self,
        domain_id: int,
        sensor: SyntheticSensor = RADAR,
        namespace: str = '',
        check: Callable[[], object] | None = None,
    ) -> None:
        self.sensor, self.domain_id = sensor, domain_id
        self.peer = peer = Peer(domain_id, 'probe', namespace, *([check] if check else []))
        # What it can do as any peer.
        self.node, self.tell, self.hear = peer.node, peer.tell, peer.hear
        self.spin_until, self.call = peer.spin_until, peer.call
        self.tables: list[Any] = []
        self.diagnostics: list[Any] = []
        self.plots = peer.tell(PointCloud2, sensor.topic)
        self._ends = [
            self.plots,
            peer.hear(PointCloud2, f'{sensor.node}/tracks', self.tables),
            peer.hear(DiagnosticArray, '/diagnostics', self.diagnostics),
        ]
        self.stamp = START - sensor.period  # of the newest scan [s]

    def __enter__(self) -> TrackerProbe:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Leave the graph."""
        self.peer.close()

    def wait_for_tracker(self, deadline: float = DEADLINE) -> None:
        """Wait until the tracker's tracks and diagnostics are there, whoever sends its plots."""
        self.peer.wait_until_matched(*self._ends[1:], deadline=deadline)

    def meet(self, deadline: float = DEADLINE) -> None:
        """
        Wait until the node and the probe hear each other, both ways.

        The node may know of the probe later than the probe of the node; the proof is an answer.
        So the node gets empty scans until it answers one; `reset` makes it forget them.
        """
        self.peer.wait_until_matched(*self._ends, deadline=deadline)
        heard = len(self.tables)

        def greet(_: int) -> None:
            self.stamp += 1e-3
            nothing = {k: v[:0] for k, v in self.sensor.contacts(self.stamp).items()}
            self.send(nothing, self.stamp)

        self.peer.ask(
            greet, lambda: len(self.tables) > heard, 'an answer to an empty scan', GREETING,
            deadline,
        )  # fmt: skip
        # Where the answer was slow, there are more to come.
        self.peer.spin(lambda: self.is_answered(self.stamp), AGAIN)

    def reset(self) -> None:
        """Let the tracker forget all tracks and stamps."""
        if not self.call(Trigger, f'{self.sensor.node}/reset', Trigger.Request()).success:
            raise AssertionError('the tracker does not forget')

    def send(self, columns: Mapping[str, Any], stamp: float, frame: str = '') -> Any:
        """Publish plots; return the message."""
        msg = from_columns(columns, stamp, frame or self.sensor.frame, rclpy_types())
        self.plots.publish(msg)
        return msg

    def answer(self, columns: Mapping[str, Any]) -> Columns:
        """Publish plots of the present stamp; return the track table that answers them."""
        self.send(columns, self.stamp)
        self.spin_until(lambda: self.is_answered(self.stamp), f'tracks of {self.stamp}')
        return to_columns(self.tables[-1], MAX_ROWS)

    def is_answered(self, stamp: float) -> bool:
        """Return whether the last track table has this stamp [s]."""
        return bool(self.tables) and _is_at(self.tables[-1], stamp)

    def scan(
        self,
        stamp: float | None = None,
        extra: Mapping[str, Any] | None = None,
        empty: bool = False,
    ) -> Columns:
        """Publish the next scan of all contacts; return the track table that answers it."""
        self.stamp = self.stamp + self.sensor.period if stamp is None else stamp
        columns = self.sensor.contacts(self.stamp)
        if empty:
            columns = {name: values[:0] for name, values in columns.items()}
        for name, values in (extra or {}).items():
            columns[name] = np.concatenate([columns[name], values])
        return self.answer(columns)

    def confirmed(self, scans: int = 12) -> Columns:
        """Publish scans until all contacts are confirmed tracks; return the last table."""
        for _ in range(scans):
            table = self.scan()
            if np.sum(table['status'] == CONFIRMED) == self.sensor.count:
                return table
        raise AssertionError(f'not all confirmed in {scans} scans: {table["status"]}')

    def collect(self, count: int, deadline: float = DEADLINE) -> list[Columns]:
        """Return the next track tables, whoever sends the plots; TimeoutError after `deadline`."""
        heard = len(self.tables)
        self.spin_until(
            lambda: len(self.tables) >= heard + count, f'{count} track tables', deadline
        )
        return [to_columns(msg, MAX_ROWS) for msg in self.tables[heard : heard + count]]

    def until_diagnosed_at(self, time: float) -> None:
        """Wait until the node's clock, as its diagnostics show it, is there."""
        self.spin_until(
            lambda: (said := self._own_diagnostics()) and _is_at(said[0], time), f'clock at {time}'
        )

    def diagnosed(self, key: str) -> str | None:
        """Return a value of the last diagnostics of the node, None before there are any."""
        said = self._own_diagnostics()
        return next((v.value for v in said[1].values if v.key == key), None) if said else None

    def _own_diagnostics(self) -> tuple[Any, Any] | None:
        """Return the last message with a word of our tracker, and that: any node may speak."""
        name = f'{self.node.get_namespace()}/{self.sensor.node}: '.lstrip('/')
        told = ((msg, status) for msg in reversed(self.diagnostics) for status in msg.status)
        return next((pair for pair in told if pair[1].name.startswith(name)), None)


def _is_at(msg: Any, stamp: float) -> bool:
    return abs(seconds(msg.header.stamp) - stamp) < SAME
