# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What tests of the tools share: a short piece of the demo scene, a browser."""

from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
import shutil
from typing import Any

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from tracking_tools.bags import BagWriter, open_bag
from tracking_tools.scoring import TrackRows, Truth

DEMO = Path(__file__).parents[2] / 'demo' / 'terminal_area'
CHROMIUM = next(filter(None, map(shutil.which, ('chromium', 'chromium-browser', 'google-chrome'))),
                None)  # fmt: skip
FLAGS = [
    '--headless', '--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-sync',
    '--disable-background-networking', '--disable-component-update',
]  # fmt: skip


@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """Yield a browser without a window."""
    driven = pytest.importorskip('playwright.sync_api', reason='playwright is not installed')
    if CHROMIUM is None:
        pytest.skip('no chromium on this machine')
    with driven.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield running
        running.close()


@pytest.fixture(scope='session')
def cut_bag(tmp_path_factory: pytest.TempPathFactory) -> Callable[[int], Path]:
    """Return a function that makes a bag of the first turns of the demo scene."""
    folder = tmp_path_factory.mktemp('cut')

    def cut(turns: int) -> Path:
        path = folder / f'turns_{turns}'
        if not path.exists():
            with open_bag(DEMO) as bag, BagWriter(path) as out:
                for connection, time, raw in islice(bag.messages(), 2 * turns):
                    out.write_raw(connection.topic, connection.msgtype, raw, time)
        return path

    return cut


@pytest.fixture(scope='session')
def messages() -> Callable[[Path, str], list[tuple[int, Any]]]:
    """Return a function that reads (time [ns], message) of all messages on a topic."""

    def messages(bag: Path, topic: str) -> list[tuple[int, Any]]:
        with open_bag(bag) as reader:
            chosen = [c for c in reader.connections if c.topic == topic]
            return [
                (time, reader.deserialize(raw, connection.msgtype))
                for connection, time, raw in reader.messages(chosen)
            ]

    return messages


@pytest.fixture(scope='session')
def plots_message() -> Callable[..., Any]:
    """Return a function that makes a plots message from a stamp [s] and columns."""

    def plots_message(time: float, **columns: list[float]) -> Any:
        arrays = {name: np.array(values, np.float32) for name, values in columns.items()}
        return from_columns(arrays, time, 'radar', rosbags_types())

    return plots_message


@pytest.fixture(scope='session')
def random_scene() -> Callable[[int], tuple[TrackRows, Truth]]:
    """
    Return a function that makes tracks and truth of 30 scans for a seed.

    Six contacts that come and go; tracks with errors, gaps, doubles, a false one.
    """

    def scene(seed: int) -> tuple[TrackRows, Truth]:
        rng = np.random.default_rng(seed)
        samples, said = [], []
        for contact in range(6):
            first, last = rng.integers(0, 8), rng.integers(20, 30)
            start, velocity = rng.uniform(-60.0, 60.0, 2), rng.uniform(-4.0, 4.0, 2)
            for k in range(first, last + 1):
                place = start + k * velocity
                samples.append([contact, k, *place, *velocity])
                for double in range(1 + (contact == 3)):
                    if rng.uniform() < 0.85:
                        track = 10 * contact + double + 100 * (k > 14)
                        error = rng.normal(0.0, [6.0, 6.0, 1.0, 1.0])
                        said.append([k, track, *(np.array([*place, *velocity]) + error)])
        said += [[k, 999, *rng.uniform(-60.0, 60.0, 2), 0.0, 0.0] for k in range(4, 20)]
        table, real = np.array(sorted(said)), np.array(samples)
        root = rng.normal(0.0, 1.0, (len(table), 4, 4)) + 5.0 * np.eye(4)
        rows = TrackRows(
            table[:, 0].astype(int), table[:, 1].astype(int), table[:, 0], table[:, 2:4],
            table[:, 4:], root @ root.transpose(0, 2, 1),
        )  # fmt: skip
        return rows, Truth.of(real[:, 0].astype(int), real[:, 1], real[:, 2:4], real[:, 4:])

    return scene
