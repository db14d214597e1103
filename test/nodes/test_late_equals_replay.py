# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A bag whose odometry comes late, played to the live node and replayed: the same rows."""

from dataclasses import replace

from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rcl_interfaces.srv import GetParameters
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import PointCloud2

from benchmarks.late_odometry import contacts, messages, odometry, PERIOD, plots_of, VALUES
from msg_adapters.message_types import rosbags_types
from tracking_tools.bags import BagWriter, nanoseconds, open_bag
from tracking_tools.parameter_file import configure
from tracking_tools.replay import replay
from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.listening import listen
from tracking_tools.scenarios.messages import EPOCH
from tracking_tools.scenarios.watches import long_watch
from tracking_tools.sensors import SENSORS

TURNS, PARTS, CYCLES = 12, 8, 25
PARAMETERS = {'radar': {**VALUES, 'scan.assembly': 'sector'}, 'sonar': {}}


def radar_events():
    """Yield when what comes to a radar in sectors; odometry of 2 Hz is 0.7 s late."""
    rng = np.random.default_rng(1)
    for event in messages(*plots_of(rng, *contacts(rng)), PARTS):
        if event.received < TURNS * PERIOD:
            yield event.received, 'plots', event.msg
    for time in np.arange(-1.0, TURNS * PERIOD, 0.5):
        yield time + 0.7, 'ownship', odometry(time)


def sonar_events():
    """Yield the same of an array: odometry is 0.7 s later than the marks of its time."""
    watch, turns = long_watch(), (Leg(7.0), Leg(9.0, 0.05), Leg(9.0, -0.05), Leg(9.0, 0.05))
    own = Legs((0.0, 0.0, 0.0), 3.0, 1.5, turns)
    watch = replace(watch, own=own, duration=CYCLES * watch.array.period)
    for together in listen(watch, rosbags_types()):
        for topic, msg, time in together:
            if topic != 'truth':
                yield time + (0.7 if topic == 'ownship' else 0.0), topic, msg


EVENTS = {'radar': radar_events, 'sonar': sonar_events}


@pytest.fixture(params=SENSORS)
def sensor(request):
    """Test both nodes."""
    return request.getfixturevalue(request.param)


def play(bag, probe, node):
    """Publish all messages of a bag, each when the node, which has one thread, has the last."""
    kinds = {'ownship': Odometry, probe.sensor.topic: PointCloud2}
    ends = {'ownship': probe.tell(Odometry, 'ownship'), probe.sensor.topic: probe.plots}
    probe.meet()
    probe.peer.wait_until_matched(*ends.values())
    probe.reset()
    probe.tables.clear()
    request = GetParameters.Request(names=['ownship_patience'])
    with open_bag(bag) as reader:
        for connection, _, raw in reader.messages():
            topic = connection.topic.strip('/')
            ends[topic].publish(deserialize_message(bytes(raw), kinds[topic]))
            probe.call(GetParameters, f'{node}/get_parameters', request)


def test_live_node_and_replay_wait_alike(start_node, probe, sensor, tmp_path):
    """Every column of every row, bit for bit, up to what still waits at the end."""
    kind = next(kind for kind in SENSORS if SENSORS[kind].node == sensor.node)
    with BagWriter(tmp_path / 'bag') as out:
        for time, topic, msg in sorted(EVENTS[kind](), key=lambda event: event[0]):
            out.write(topic, msg, nanoseconds(EPOCH + time))
    topics = ('ownship', sensor.topic)
    reliable = [f'qos_overrides./{topic}.subscription.reliability:=reliable' for topic in topics]
    values = {**PARAMETERS[kind], 'ownship_patience': 20.0}
    start_node(*reliable, *(f'{name}:={value}' for name, value in values.items()))
    play(tmp_path / 'bag', probe, sensor.node)
    configs = configure(SENSORS[kind].configs, values)
    where, tables = tmp_path / 'replayed', []
    replay(tmp_path / 'bag', where, configs, quiet=True, sensor=SENSORS[kind])
    with open_bag(where) as reader:
        for connection, _, raw in reader.messages():
            tables.append(reader.deserialize(raw, connection.msgtype))
    live = [bytes(table.data) for table in probe.tables]
    replayed = [bytes(table.data) for table in tables]
    assert 0 <= len(replayed) - len(live) < 5
    assert live == replayed[: len(live)]
    assert sum(map(len, live)) > 10_000
    waited = f'{sensor.topic} waited [s]'
    probe.spin_until(lambda: float(probe.diagnosed(waited) or 0.0) > 0.0, waited)
