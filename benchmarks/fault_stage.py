# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A live radar tracker, a radar that turns in real time, and what a user sees of both."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
import signal
import sys
import time

from nav_msgs.msg import Odometry
import numpy as np
from rosgraph_msgs.msg import Clock

from benchmarks.fault_scene import Scene
from benchmarks.shared_memory import shared_memory
from msg_adapters.message_types import rclpy_types, seconds
from msg_adapters.track_rows import CONFIRMED
from tracking_tools.testing import NodeProcess, python_node, to_columns, TrackerProbe

ROOT = Path(__file__).parents[1]
PERIOD = 0.25  # s between scans, in real time
NEAR = 300.0  # m between a contact and its track
GIVE_UP = 60.0  # s


class Stage:
    """
    One tracker in a ROS graph, and the messages that a fault may change.

    Parameters
    ----------
    domain_id : int
        ROS domain.
    folder : Path
        For logs.
    parameters : tuple of str
        Of the node.
    is_afloat, has_clock : bool
        Whether own ship and /clock are published.

    """

    def __init__(
        self,
        domain_id: int,
        folder: Path,
        *parameters: str,
        is_afloat: bool = False,
        has_clock: bool = False,
    ) -> None:
        self._domain_id, self._folder, self._parameters = domain_id, folder, parameters
        self.open = ExitStack()
        self.scene, self.shift = Scene(time.time(), is_afloat), 0.0  # of the clock [s]
        self.probe = self.open.enter_context(TrackerProbe(domain_id))
        self._ownship = self.probe.tell(Odometry, 'ownship') if is_afloat else None
        self._clock = self.probe.tell(Clock, '/clock') if has_clock else None
        self._due, self.scans_due, self.lapses = time.monotonic(), 0, 0
        self.nodes: list[NodeProcess] = []
        self.ids: set[int] = set()  # of the tracks that are where the contacts are
        self._counts: dict[str, float] = {}

    def start_node(self, *arguments: str) -> NodeProcess:
        """Start a tracker; it ends with the stage."""
        words = [word for parameter in self._parameters for word in ('-p', parameter)]
        return self._start(python_node('radar_tracker.node', *words, *arguments))

    def start_source(self, what: str) -> NodeProcess:
        """Start a process that publishes `plots` or `ownship`; it ends with the stage."""
        command = [sys.executable, '-m', 'benchmarks.fault_publisher', what]
        afloat = 'afloat' if self.scene.is_afloat else 'ashore'
        return self._start([*command, repr(self.scene.begin), afloat])

    def _start(self, command: list[str]) -> NodeProcess:
        log = self._folder / f'{len(self.nodes)}.log'
        self.nodes.append(NodeProcess(command, self._domain_id, log, folder=ROOT))
        return self.open.enter_context(self.nodes[-1])

    def kill(self, node: NodeProcess) -> None:
        """End a process at once, as a crash would; what it leaves goes with the stage."""
        for file in shared_memory(node.process.pid):
            self.open.callback(file.unlink, missing_ok=True)
        node.signal(signal.SIGKILL)
        node.wait()

    @property
    def now(self) -> float:
        """Stamp of this moment [s]."""
        return time.time() + self.shift

    def tick(self) -> float:
        """Wait for the next scan to be due, count whether tracks are held; return its stamp."""
        self._due = max(self._due + PERIOD, time.monotonic() - PERIOD)
        self.probe.peer.spin(lambda: False, self._due - time.monotonic())
        self.scans_due += 1
        self.lapses += not self.holds()
        return self.now

    def tell_time(self, stamp: float) -> None:
        """Publish /clock, where there is one."""
        if self._clock is not None:
            self._clock.publish(Clock(clock=rclpy_types().header(stamp, '').stamp))

    def tell_own_ship(self, stamp: float, leap: float = 0.0) -> None:
        """Publish odometry, where there is a ship."""
        if self._ownship is not None:
            self._ownship.publish(self.scene.odometry(stamp, leap))

    def plots(self) -> None:
        """Send plots when they are due, and nothing else."""
        stamp = self.tick()
        self.probe.send(self.scene.plots(stamp), stamp)

    def scan(self) -> None:
        """Send all that belongs to one scan, when it is due."""
        stamp = self.tick()
        self.tell_time(stamp)
        self.tell_own_ship(stamp)
        self.probe.send(self.scene.plots(stamp), stamp)

    def idle(self) -> None:
        """Let the time of one scan pass: somebody else sends it, or nobody."""
        self.tick()

    def scans(self, count: int, scan: Callable[[], None] | None = None) -> None:
        """Send so many scans."""
        for _ in range(count):
            (scan or self.scan)()

    def holds(self) -> set[int]:
        """Return the ids of the tracks that are where the contacts are; empty unless all are."""
        if not self.probe.tables:
            return set()
        table = self.probe.tables[-1]
        stamp, rows = seconds(table.header.stamp), to_columns(table, 10_000)
        sure = rows['status'] == CONFIRMED
        place = np.stack([rows['x'][sure], rows['y'][sure]], axis=1)
        if len(place) == 0 or abs(stamp - self.now) > 4.0 * PERIOD:
            return set()
        apart = np.linalg.norm(self.scene.contacts(stamp)[:, None] - place, axis=2)
        near = rows['id'][sure][np.argmin(apart, axis=1)]
        return set(near.tolist()) if (apart.min(axis=1) < NEAR).all() else set()

    def until_held(self, scan: Callable[[], None] | None = None) -> tuple[int, float]:
        """Send scans until all contacts are held, by `ids`; return scans and seconds."""
        begin, before = time.monotonic(), self.scans_due
        while not (ids := self.holds()):
            if time.monotonic() - begin > GIVE_UP:
                raise TimeoutError(f'tracks did not come back within {GIVE_UP:g} s')
            (scan or self.scan)()
        self.ids = ids
        return self.scans_due - before, time.monotonic() - begin

    def note(self) -> None:
        """Begin to watch what the diagnostics say."""
        self.probe.peer.spin(lambda: False, 1.2)  # they come once a second
        self._counts, self.lapses = self._values(), 0
        self.probe.diagnostics.clear()

    def seen(self) -> str:
        """Return what was said since, and which counts have changed."""
        self.probe.peer.spin(lambda: False, 1.2)
        statuses = [status for msg in self.probe.diagnostics for status in msg.status]
        texts = list(dict.fromkeys(s.message for s in statuses if s.level != s.OK))
        counts = self._values()
        changed = [
            f'`{key}` {value - self._counts.get(key, 0.0):+g}' for key, value in counts.items()
            if value > self._counts.get(key, 0.0)
        ]  # fmt: skip
        return '; '.join([*(f'WARN "{text}"' for text in texts), *changed]) or 'nothing'

    def _values(self) -> dict[str, float]:
        """Return the counts in the last diagnostics that tell of faults."""
        status = self.probe.diagnostics[-1].status[0] if self.probe.diagnostics else None
        values = {v.key: v.value for v in status.values} if status else {}
        told = ('refused:', 'lost', 'shed', 'late,', 'jumps', 'silences')
        return {k: float(v) for k, v in values.items() if any(word in k for word in told)}

    def settle(self, scan: Callable[[], None] | None = None) -> set[int]:
        """Send scans until all contacts are held, and for some time more; return their ids."""
        self.until_held(scan)
        self.scans(8, scan)
        self.note()
        self.scans(4, scan)
        self.until_held(scan)
        self.lapses = 0
        return self.ids
