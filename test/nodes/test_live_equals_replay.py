# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The same bag, played to the live node and replayed without a graph: the same rows."""

from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools.bags import BagWriter, nanoseconds, open_bag
from tracking_tools.demo_player import play
from tracking_tools.replay import read_configs, replay
from tracking_tools.replay_topics import Topics
from tracking_tools.scenarios.listening import listen
from tracking_tools.scenarios.messages import EPOCH
from tracking_tools.scenarios.watches import long_watch
from tracking_tools.sensors import SENSORS

ROOT = Path(__file__).parents[2]
PARAMETERS = {'radar': 'terminal_radar.yaml', 'sonar': 'passive_linear_array.yaml'}
TURNS, CYCLES = 40, 60


def record_radar(path):
    """Cut the beginning of the demo's recording of real flights."""
    with open_bag(ROOT / 'demo' / 'terminal_area') as bag, BagWriter(path) as out:
        for connection, time, raw in islice(bag.messages(), 2 * TURNS):  # plots and truth
            out.write_raw(connection.topic, connection.msgtype, raw, time)


def record_sonar(path):
    """Let a ship that moves listen: marks and its odometry."""
    watch = long_watch()
    watch = replace(watch, duration=CYCLES * watch.array.period)
    with BagWriter(path) as out:
        for together in listen(watch, rosbags_types()):
            for topic, msg, time in together:
                out.write(topic, msg, nanoseconds(EPOCH + time))


RECORD = {'radar': record_radar, 'sonar': record_sonar}


def tables(bag, topic):
    """Return (stamp, frame, columns) of every track table in a bag."""
    with open_bag(bag) as reader:
        chosen = [c for c in reader.connections if c.topic == topic]
        found = [reader.deserialize(raw, c.msgtype) for c, _, raw in reader.messages(chosen)]
    return [(m.header.stamp, m.header.frame_id, to_columns(m, 10_000)) for m in found]


@pytest.mark.parametrize('kind', SENSORS)
def test_live_node_and_replay_give_the_same_rows(kind, tmp_path):
    """Every message is answered, and every column of every row is the same, bit for bit."""
    sensor, parameters = SENSORS[kind], ROOT / 'config' / PARAMETERS[kind]
    RECORD[kind](tmp_path / 'recording')
    play(tmp_path / 'recording', tmp_path / 'live', parameters, 1e9, tmp_path / 'log', sensor)
    configs = read_configs(parameters, {}, sensor)
    replay(tmp_path / 'recording', tmp_path / 'replay', configs, quiet=True, sensor=sensor)
    topic = Topics.of(sensor).tracks
    live, replayed = tables(tmp_path / 'live', topic), tables(tmp_path / 'replay', topic)
    assert len(live) == len(replayed) == {'radar': TURNS, 'sonar': CYCLES}[kind]
    assert sum(len(columns['id']) for _, _, columns in live) > len(live)
    for (*head, one), (*other_head, other) in zip(live, replayed, strict=True):
        assert head == other_head
        assert list(one) == list(other)
        for name in one:
            np.testing.assert_array_equal(one[name], other[name], name)
