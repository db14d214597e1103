# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A node as its own process, and a probe that publishes to it and hears what it says."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
import signal
import subprocess
import sys
import threading
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
import numpy as np
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile
from sensor_msgs.msg import PointCloud2

from msg_adapters.message_types import rclpy_types, seconds
from msg_adapters.table import from_columns, to_columns

ROOT = Path(__file__).parents[2]
DEADLINE = 20.0  # s; discovery takes 2.4 s on a loaded machine
START = 1_000_000.0  # s, stamp of the first scan
PERIOD = 4.0  # s between scans
DEGREE = np.pi / 180.0


@dataclass(frozen=True)
class Sensor:
    """What a test node sends to which tracker."""

    node: str  # its name and its package
    topic: str
    frame: str
    contacts: Callable[[float], dict[str, Any]]  # columns at a stamp [s]
    count: int  # of the contacts


class NodeProcess:
    """A tracker node as its own process, with all that it logs."""

    def __init__(self, node: str, *parameters: str) -> None:
        arguments = [word for parameter in parameters for word in ('-p', parameter)]
        self._process = subprocess.Popen(
            [sys.executable, '-m', f'{node}.node', '--ros-args', *arguments],
            cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        self._lines: list[str] = []
        self._heard = threading.Condition()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        for line in self._process.stdout:
            with self._heard:
                self._lines.append(line)
                self._heard.notify_all()

    @property
    def log(self) -> str:
        """Everything said so far."""
        with self._heard:
            return ''.join(self._lines)

    def wait_for_line(self, text: str) -> str:
        """Return the first line with this text, waiting for it."""
        with self._heard:
            assert self._heard.wait_for(
                lambda: any(text in line for line in self._lines), DEADLINE
            ), f'never said {text!r}:\n{"".join(self._lines)}'
            return next(line for line in self._lines if text in line)

    def signal(self, number: int) -> None:
        """Send a signal."""
        self._process.send_signal(number)

    def wait(self) -> int:
        """Return the exit code."""
        code = self._process.wait(DEADLINE)
        self._reader.join(DEADLINE)
        self._process.stdout.close()
        return code

    def stop(self) -> int:
        """End the process as a user would, if it still runs."""
        if self._process.poll() is None:
            self.signal(signal.SIGINT)
        try:
            return self.wait()
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise


class Probe:
    """A ROS node of the test: sends plots, keeps track tables and diagnostics."""

    def __init__(self, domain_id: int, sensor: Sensor) -> None:
        self.sensor = sensor
        self._context = Context()
        rclpy.init(args=[], context=self._context, domain_id=domain_id)
        self.node = rclpy.create_node('probe', context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self.tables: list[Any] = []
        self.diagnostics: list[Any] = []
        self.plots = self.node.create_publisher(PointCloud2, sensor.topic, 50)
        self._ends = [
            self.hear(PointCloud2, f'{sensor.node}/tracks', self.tables),
            self.hear(DiagnosticArray, '/diagnostics', self.diagnostics),
        ]
        self.stamp = START - PERIOD  # of the newest scan

    def hear(self, kind: Any, topic: str, into: list[Any]) -> Any:
        """Subscribe, and keep every message."""
        return self.node.create_subscription(kind, topic, into.append, QoSProfile(depth=1000))

    def close(self) -> None:
        """Leave the graph."""
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def spin_until(self, is_done: Callable[[], object], what: str = '') -> None:
        """Let messages come until something holds."""
        end = time.monotonic() + DEADLINE
        while not is_done():
            assert time.monotonic() < end, f'waited {DEADLINE} s in vain: {what}'
            self._executor.spin_once(timeout_sec=0.05)

    def meet(self) -> None:
        """Wait until the node and the probe hear each other, both ways."""
        self.spin_until(
            lambda: (
                self.plots.get_subscription_count()
                and all(end.get_publisher_count() for end in self._ends)
            ),
            'discovery',
        )
        # The node may know of the probe later than the probe of the node.
        heard = len(self.tables)
        end = time.monotonic() + DEADLINE
        while len(self.tables) == heard:
            assert time.monotonic() < end, 'no answer to any empty scan'
            self.stamp += 1e-3
            nothing = {k: v[:0] for k, v in self.sensor.contacts(self.stamp).items()}
            self.send(nothing, self.stamp)
            self._executor.spin_once(timeout_sec=0.1)

    def call(self, kind: Any, service: str, request: Any) -> Any:
        """Return the answer of a service."""
        client = self.node.create_client(kind, service)
        self.spin_until(client.service_is_ready, service)
        future = client.call_async(request)
        self.spin_until(future.done, service)
        self.node.destroy_client(client)
        return future.result()

    def send(self, columns: dict[str, Any], stamp: float, frame: str = '') -> Any:
        """Publish plots."""
        msg = from_columns(columns, stamp, frame or self.sensor.frame, rclpy_types())
        self.plots.publish(msg)
        return msg

    def scan(
        self, stamp: float | None = None, extra: dict[str, Any] | None = None, empty: bool = False
    ) -> dict[str, Any]:
        """Publish the next scan of all contacts and return the track table that answers it."""
        self.stamp = self.stamp + PERIOD if stamp is None else stamp
        columns = self.sensor.contacts(self.stamp)
        if empty:
            columns = {name: values[:0] for name, values in columns.items()}
        for name, values in (extra or {}).items():
            columns[name] = np.concatenate([columns[name], values])
        return self.answer(columns)

    def answer(self, columns: dict[str, Any]) -> dict[str, Any]:
        """Publish plots of the present stamp and return the track table that answers them."""
        self.send(columns, self.stamp)
        self.spin_until(
            lambda: self.tables and abs(seconds(self.tables[-1].header.stamp) - self.stamp) < 1e-6,
            f'tracks of {self.stamp}',
        )
        return to_columns(self.tables[-1], 10_000)

    def confirmed(self, scans: int = 12) -> dict[str, Any]:
        """Publish scans until all contacts are confirmed tracks; return the last table."""
        for _ in range(scans):
            table = self.scan()
            if np.sum(table['status'] == 1) == self.sensor.count:
                return table
        pytest.fail(f'not all confirmed in {scans} scans: {table["status"]}')

    def until_diagnosed_at(self, time: float) -> None:
        """Wait until the node's clock, as its diagnostics show it, is there."""
        self.spin_until(
            lambda: (
                self.diagnostics and abs(seconds(self.diagnostics[-1].header.stamp) - time) < 1e-6
            ),
            f'clock at {time}',
        )

    def diagnosed(self, key: str) -> str | None:
        """Return a value of the last diagnostics of the node."""
        status = self.diagnostics[-1].status[0] if self.diagnostics else None
        return next((v.value for v in status.values if v.key == key), None) if status else None


def contacts(stamp: float) -> dict[str, Any]:
    """Return the plots of three contacts that fly straight, as float32 columns."""
    time_flown = stamp - START
    rng = np.random.default_rng(int(time_flown * 10) % 2**32)
    x = np.array([20e3, -15e3, 5e3]) + np.array([150.0, 100.0, -120.0]) * time_flown
    y = np.array([5e3, 18e3, -25e3]) + np.array([-80.0, 120.0, 90.0]) * time_flown
    distance = np.hypot(x, y) + rng.normal(0.0, 20.0, 3)
    azimuth = np.arctan2(y, x) + rng.normal(0.0, 1e-3, 3)
    order = np.argsort(azimuth % (2.0 * np.pi))
    columns = {'range': distance[order], 'azimuth': azimuth[order]}
    return {name: values.astype(np.float32) for name, values in columns.items()}


def marks(stamp: float) -> dict[str, Any]:
    """Return the marks of twenty contacts all around, two of them on either side of +-pi."""
    rng = np.random.default_rng(int((stamp - START) * 10) % 2**32)
    start = 18.0 * np.arange(20) - 171.5
    rate = np.where(np.arange(20) % 2, 0.01, -0.01)
    bearing = (start + rate * (stamp - START) + rng.normal(0.0, 0.2, 20)) * DEGREE
    return {'bearing': (bearing + 0.01 * DEGREE).astype(np.float32)}


RADAR = Sensor('radar_tracker', 'plots', 'radar', contacts, 3)
SONAR = Sensor('sonar_tracker', 'bearings', 'sonar', marks, 20)


@pytest.fixture
def radar() -> Sensor:
    """Return the radar."""
    return RADAR


@pytest.fixture
def sonar() -> Sensor:
    """Return the sonar."""
    return SONAR


@pytest.fixture
def sensor(radar: Sensor) -> Sensor:
    """Return the radar; tests of the sonar say otherwise."""
    return radar


@pytest.fixture
def start_node(ros_domain_id: int, sensor: Sensor) -> Iterator[Callable[..., NodeProcess]]:
    """Start nodes that end with the test."""
    started: list[NodeProcess] = []

    def start(*parameters: str) -> NodeProcess:
        started.append(NodeProcess(sensor.node, *parameters))
        return started[-1]

    yield start
    for process in started:
        process.stop()
        print(process.log)  # shown where a test fails


@pytest.fixture
def probe(ros_domain_id: int, sensor: Sensor) -> Iterator[Probe]:
    """Give a probe in the domain of the test."""
    probe = Probe(ros_domain_id, sensor)
    yield probe
    probe.close()
