# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A live node stands hostile messages on all its topics, also such as no publisher could send."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import UInt32

from benchmarks.healthy_scenes import HEALTHY, START
from benchmarks.hostile_messages import spoil
from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns
from tracking_tools.testing import confirmed_ids

SHORT, LONG = 60, 10_500  # messages, some of which cannot be sent
EXTREMES = (b'\xff\xff\xff\xff', b'\xff\xff\xff\x7f', b'\0\0\1\0')
OTHERS = {'ownship': Odometry, 'acquire': PointStamped, 'cancel': UInt32}
STEP, AGAIN = 2.0, 1.0  # s of stamps between healthy scans; before the next one if unanswered
PLACES, FIELDS = 50, 80_000  # that the transport keeps for messages; of the largest in a siege
GROWTH = 1.03  # of memory, once every place of the transport has room for the largest message


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes, with contacts that never leave."""
    of_tests = request.getfixturevalue(request.param)
    contacts = HEALTHY[request.param]
    return replace(of_tests, contacts=contacts, count=len(next(iter(contacts(START).values()))))


def damage(data, rng):
    """Return a serialised message cut, flipped, with a huge number in it, or any bytes."""
    spoilt = bytearray(data)
    kind, place = rng.integers(4), int(rng.integers(0, len(data)))
    if kind == 0:
        return bytes(spoilt[:place])
    if kind == 1:
        for flipped in rng.integers(0, len(data), 3):
            spoilt[flipped] ^= int(rng.integers(1, 256))
    elif kind == 2:
        spoilt[place // 4 * 4 : place // 4 * 4 + 4] = EXTREMES[rng.integers(len(EXTREMES))]
    else:
        return rng.bytes(int(rng.integers(4, 300)))
    return bytes(spoilt)


class Attack:
    """What is sent to one node, and what is asked of it."""

    def __init__(self, node, probe, seed):
        self.node, self.probe, self.rng = node, probe, np.random.default_rng(seed)
        self.others = {name: probe.tell(kind, name) for name, kind in OTHERS.items()}
        probe.peer.wait_until_matched(*self.others.values())
        self.kept, self.sent = confirmed_ids(probe.confirmed()), Counter()

    def fill_places(self):
        """Send the largest message that there is to every place in which one may wait."""
        field = PointField(name='range', datatype=PointField.FLOAT32, count=1)
        for _ in range(3):
            for _ in range(PLACES):
                self._publish('large', self.probe.plots, PointCloud2(fields=[field] * FIELDS))
            self.feed()

    def strike(self):
        """Send one hostile message: spoilt plots, or damaged bytes on any topic."""
        probe, rng = self.probe, self.rng
        columns, stamp = probe.sensor.contacts(probe.stamp + 1.0), probe.stamp + 1.0
        if rng.random() < 0.7:
            cloud = spoil(columns, stamp, probe.sensor.frame, rng)
            return self._publish('plots', probe.plots, cloud.to_message(rclpy_types()))
        topic = str(rng.choice(['plots', *OTHERS]))
        msg = OTHERS.get(topic, UInt32)()
        if topic == 'plots':
            msg = spoil(columns, stamp, probe.sensor.frame, rng).to_message(rclpy_types())
        end, data = self.others.get(topic, probe.plots), damage(serialize_message(msg), rng)
        if topic == 'cancel' and int.from_bytes(data[4:8], 'little') in self.kept:
            data = b''  # an order to drop one of the tracks would be obeyed
        return self._publish(f'{topic}, raw', end, data)

    def _publish(self, name, end, msg):
        try:
            end.publish(msg)
            self.sent[name] += 1
        except Exception:  # the middleware of the sender refuses some bytes: nothing was sent
            self.sent['not sent'] += 1

    def feed(self):
        """Send healthy scans until one is answered; every track that is fed must be there."""
        probe, heard = self.probe, len(self.probe.tables)

        def scan(_):
            probe.stamp += STEP
            probe.send(probe.sensor.contacts(probe.stamp), probe.stamp)

        probe.peer.ask(scan, lambda: probe.is_answered(probe.stamp), 'an answer', AGAIN)
        assert len(probe.tables) > heard
        self.node.check()
        lost = self.kept - self.ids()
        assert not lost, f'tracks {lost} are lost after {dict(self.sent)}'

    def ids(self):
        """Return the confirmed tracks of the last table."""
        return confirmed_ids(to_columns(self.probe.tables[-1], 10_000))

    def memory(self):
        """Return what the node holds [MB]."""
        statm = Path(f'/proc/{self.node.process.pid}/statm').read_text()
        return round(int(statm.split()[1]) * 4096e-6, 1)

    def go_on(self, count):
        """
        Strike so often; return the memory.

        Two healthy scans follow each blow: one that is well formed and lacks the contacts, or lies
        about its time by some seconds, is believed, and several in a row would cost tracks.
        """
        memory = []
        for number in range(count):
            if number % (count // 10) == 0:
                memory.append(self.memory())
                self.probe.tables[:-1] = []
            self.strike()
            self.feed()
            self.feed()
        return [*memory, self.memory()]


def test_node_stands_hostile_messages(start_node, probe):
    """It answers on, keeps the tracks that are fed, and ends with 0 and no traceback."""
    node = start_node()
    probe.meet()
    Attack(node, probe, 1).go_on(SHORT)
    node.signal(2)
    assert node.wait() == 0
    assert 'Traceback' not in node.log


@pytest.mark.soak
def test_node_stands_many_hostile_messages(start_node, probe, sensor):
    """The same ten thousand times, and memory stays what it was before."""
    node = start_node()
    probe.meet()
    attack = Attack(node, probe, 1)
    attack.fill_places()
    memory = attack.go_on(LONG)
    print(f'\n{sensor.node}: {dict(attack.sent)}, memory [MB] {memory}')
    assert max(memory) <= GROWTH * memory[0]
    node.signal(2)
    assert node.wait() == 0
    assert 'Traceback' not in node.log
