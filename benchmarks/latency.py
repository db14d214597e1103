# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How long from plots in to tracks out, beside a node that only sends on what it hears?

``python -m benchmarks.latency`` starts the radar node and a relay, each as its own process, sends
both the same plots in turn, and prints the time from publishing a message to hearing its answer,
and the processor time of each node. Between them the tracker is driven without a graph: the node
may be slower than the relay by one and a half of what that takes.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
import logging
from pathlib import Path
import sys
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time
from typing import Any

import numpy as np
from sensor_msgs.msg import PointCloud2

from benchmarks.machine import machine
from benchmarks.processes import cpu_time
from msg_adapters.message_types import rclpy_types
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.batches import Floats
from tracking_session.session import Session
from tracking_tools.arguments import count
from tracking_tools.testing import NodeProcess, private_domain, python_node, TrackerProbe

ROOT = Path(__file__).parents[1]
TEMPLATE = Path(__file__).with_name('latency.md')
PERIOD, WARM = 4.0, 15  # s between scans; scans until all contacts are tracks
START = 1_000_000.0  # s, stamp of the first scan
ALLOWED = 1.5  # scan times that the node may be slower than the relay
MILLISECONDS = 1e3
HEAD = (
    '| contacts | relay p50 / p95 [ms] | node p50 / p95 [ms] | scan alone p50 [ms] '
    '| allowed p50 [ms] | holds | CPU a message, relay / node / scan alone [ms] |\n'
    + '|---' * 7
    + '|'
)


@dataclass(frozen=True)
class Outcome:
    """Times of every message [s]."""

    relay: Floats
    node: Floats
    alone: Floats
    alone_cpu: Floats
    cpu: tuple[float, float]  # a message, of relay and node, all they do

    @property
    def allowed(self) -> float:
        """Return the median that the node should not exceed."""
        return float(np.median(self.relay) + ALLOWED * np.median(self.alone))

    def row(self, contacts: int) -> str:
        """Return a row of a Markdown table."""
        (r50, r95), (n50, n95) = (
            MILLISECONDS * np.quantile(t, [0.5, 0.95]) for t in (self.relay, self.node)
        )
        alone, allowed = MILLISECONDS * np.median(self.alone), MILLISECONDS * self.allowed
        relay, node, used = MILLISECONDS * np.array([*self.cpu, self.alone_cpu.mean()])
        holds = 'yes' if n50 <= allowed else '**no**'
        return (
            f'| {contacts} | {r50:.1f} / {r95:.1f} | {n50:.1f} / {n95:.1f} | {alone:.1f} '
            f'| {allowed:.1f} | {holds} | {relay:.1f} / {node:.1f} / {used:.1f} |'
        )


def scans(contacts: int, number: int) -> list[Any]:
    """Return messages of a 2-D radar that sees contacts on straight courses, well apart."""
    rng = np.random.default_rng(contacts)
    side = int(np.ceil(np.sqrt(contacts)))
    grid = np.stack(np.meshgrid(*[np.linspace(-150e3, 150e3, side)] * 2), axis=-1).reshape(-1, 2)
    place, velocity = grid[:contacts] + 3e3, rng.uniform(-60.0, 60.0, (contacts, 2))
    messages = []
    for scan in range(number):
        x, y = (place + velocity * PERIOD * scan).T
        azimuth = np.arctan2(y, x) + rng.normal(0.0, 1e-3, contacts)
        order = np.argsort(azimuth % (2.0 * np.pi))
        columns = {'range': np.hypot(x, y) + rng.normal(0.0, 30.0, contacts), 'azimuth': azimuth}
        rows = {name: values[order].astype(np.float32) for name, values in columns.items()}
        messages.append(from_columns(rows, START + PERIOD * scan, 'radar', rclpy_types()))
    return messages


def follow(session: Session, msg: Any) -> tuple[float, float]:
    """Return what tracker and adapters take for a message, without a graph: time, CPU [s]."""
    began, used = perf_counter(), thread_time()
    session.plots(msg, 0.0)
    return perf_counter() - began, thread_time() - used


def ask(probe: TrackerProbe, send: Callable[[Any], None], heard: list[Any], msg: Any) -> float:
    """Return the time from publishing a message to hearing the answer [s]."""
    heard.clear()
    began = perf_counter()
    send(msg)
    probe.spin_until(lambda: heard, 'an answer')
    return perf_counter() - began


def measure(contacts: int, number: int) -> Outcome:
    """Return the times of relay and node, asked in turn."""
    messages, types = scans(contacts, WARM + number), rclpy_types()
    configs = RadarTrackerConfig(), radar_node_config()
    session = radar_session(*configs, types, logging.getLogger('alone'))
    relay_command = [sys.executable, '-m', 'benchmarks.relay']
    with (
        TemporaryDirectory() as folder,
        private_domain() as domain,
        NodeProcess(relay_command, domain, f'{folder}/relay.log', folder=ROOT) as relay,
        NodeProcess(
            python_node('radar_tracker.node'), domain, f'{folder}/node.log', folder=ROOT
        ) as node,
        TrackerProbe(domain, check=node.check) as probe,
    ):
        relayed: list[Any] = []
        into = probe.tell(PointCloud2, 'in')
        probe.peer.wait_until_matched(into, probe.hear(PointCloud2, 'out', relayed))
        probe.meet()
        probe.reset()
        times, used = [], (0.0, 0.0)
        for count, msg in enumerate(messages):
            if count == WARM:
                used = cpu_time(relay.process.pid), cpu_time(node.process.pid)
            times.append(
                (
                    ask(probe, into.publish, relayed, msg),
                    ask(probe, probe.plots.publish, probe.tables, msg),
                    *follow(session, msg),
                )
            )
        after = cpu_time(relay.process.pid), cpu_time(node.process.pid)
    cpu = ((after[0] - used[0]) / number, (after[1] - used[1]) / number)
    return Outcome(*np.array(times[WARM:]).T, cpu)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(prog='latency', description=__doc__)
    parser.add_argument('--contacts', type=count, nargs='+', default=[10, 200, 1000])
    parser.add_argument('--messages', type=count, default=100, help='measured ones of each size')
    parser.add_argument('--output', type=Path, metavar='FILE', help='write the page there, too')
    chosen = parser.parse_args(arguments)
    where, table = machine(), [HEAD]
    print(HEAD)
    for contacts in chosen.contacts:
        table.append(measure(contacts, chosen.messages).row(contacts))
        print(table[-1], flush=True)
    if chosen.output is not None:
        known = {'messages': chosen.messages, 'machine': where, 'table': '\n'.join(table)}
        chosen.output.write_text(TEMPLATE.read_text(encoding='utf-8').format(**known), 'utf-8')
    return 0


if __name__ == '__main__':
    sys.exit(main())
