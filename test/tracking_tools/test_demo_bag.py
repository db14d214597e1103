# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check that the shipped demo bag is what its script makes, and a scene worth showing."""

import os
from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest

from msg_adapters.table import to_columns
from tracking_tools.bags import open_bag

DEMO = Path(__file__).parents[2] / 'demo'
LARGEST = 1_500_000  # bytes that the repository can carry for it
MANY_ROWS = 10_000


def read(bag):
    """Topics, times and columns of the messages."""
    with open_bag(bag) as reader:
        messages = [
            (c.topic, time, reader.deserialize(raw, c.msgtype))
            for c, time, raw in reader.messages()
        ]
    return [(topic, time, to_columns(msg, MANY_ROWS)) for topic, time, msg in messages]


@pytest.fixture(scope='module')
def shipped():
    """Messages of the bag in the repository."""
    return read(DEMO / 'terminal_area')


def test_make_bag_makes_the_shipped_bag(tmp_path, shipped):
    """The same messages from flights.npz; float32 leaves the last digit to the library."""
    bag = tmp_path / 'made'
    subprocess.run(
        [sys.executable, DEMO / 'make_bag.py', '--output', bag],
        check=True,
        env=os.environ | {'PYTHONPATH': str(DEMO.parent)},
    )
    made = read(bag)
    assert len(made) == len(shipped) == 900
    for (topic, time, columns), (topic_made, time_made, columns_made) in zip(
        shipped, made, strict=True
    ):
        assert (topic, time, list(columns)) == (topic_made, time_made, list(columns_made))
        for name, column in columns.items():
            np.testing.assert_allclose(columns_made[name], column, rtol=1e-5, atol=1e-5)


def test_shipped_scene_is_small_and_has_what_is_promised(shipped):
    """450 turns, 20 contacts, 5 to 20 at a time, below 1.5 MB with all its files."""
    size = sum(path.stat().st_size for path in DEMO.rglob('*') if path.is_file())
    truth = [columns for topic, _, columns in shipped if topic == '/truth']
    at_a_time = [len(columns['id']) for columns in truth]
    assert size < LARGEST
    assert len(truth) == 450
    assert (min(at_a_time), max(at_a_time)) == (5, 20)
    assert set(np.concatenate([columns['id'] for columns in truth])) == set(range(1, 21))


def test_shipped_aircraft_fly_like_aircraft(shipped):
    """Speeds, turns and accelerations between truth rows are those of aircraft: below 1.1 g."""
    rows = [
        np.stack([*(columns[name] for name in ('id', 'x', 'y', 'z', 'vx', 'vy', 'vz'))], axis=1)
        for topic, _, columns in shipped
        if topic == '/truth'
    ]
    speed = np.concatenate([np.hypot(row[:, 4], row[:, 5]) for row in rows])
    assert speed.max() < 260.0
    assert np.percentile(speed, 1) > 20.0
    for number in range(1, 21):
        velocity = np.concatenate([row[row[:, 0] == number, 4:7] for row in rows])
        change = np.linalg.norm(np.diff(velocity, axis=0), axis=1)
        assert len(velocity) > 100
        assert np.percentile(change / 4.0, 99) < 1.1 * 9.81
