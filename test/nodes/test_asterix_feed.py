# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""An ASTERIX radar on the network becomes tracks of the radar node."""

from itertools import count
import socket
import sys
import time

import pytest
from sensor_msgs.msg import PointCloud2

from msg_adapters.message_types import seconds
from msg_adapters.table import to_columns
from tracking_tools.feeds.clock import DAY
from tracking_tools.testing import NodeProcess

generated = pytest.importorskip('asterix.generated')


def datagram(time_of_day, rho):
    """Return a data block with one plot in the east, rho [NM] away."""
    items = {
        '010': (('SAC', 25), ('SIC', 201)), '140': (time_of_day, 's'),
        '020': ((1, 0, 0, 0, 0, None),), '040': (('RHO', (rho, 'NM')), ('THETA', (90.0, '°'))),
    }  # fmt: skip
    kind = generated.Cat_048_1_32
    return kind.create([kind.cv_record.create(items)]).unparse().to_bytes()


@pytest.fixture
def feed(ros_domain_id, tmp_path):
    """Start the feed; return its process and its port."""
    with socket.socket(type=socket.SOCK_DGRAM) as free:
        free.bind(('127.0.0.1', 0))
        port = free.getsockname()[1]
    command = [sys.executable, '-m', 'tracking_tools.asterix', f'udp://127.0.0.1:{port}']
    with NodeProcess(command, ros_domain_id, tmp_path / 'feed.log') as process:
        yield process, port


def test_udp_feed_becomes_tracks(feed, start_node, probe):
    """Datagrams on the loopback, hostile ones among them, to tracks of the radar node."""
    process, port = feed
    start_node('scan.assembly:=snapshot')
    probe.wait_for_tracker()
    probe.peer.wait_for_node('/asterix_feed', deadline=60.0)
    start, steps = time.time() % DAY, count()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as radar:

        def is_tracked():
            flown = 0.25 * next(steps)
            good = datagram((start + flown) % DAY, 10.0 + 0.01 * flown)
            for data in (b'0', good, bytes([48, 255, 255]), b''):
                radar.sendto(data, ('127.0.0.1', port))
            tables = [to_columns(msg, 9) for msg in probe.tables[-1:]]
            return any((table['status'] == 1).any() for table in tables)

        probe.spin_until(is_tracked, 'a confirmed track')
    assert process.stop() == 0
    assert 'Traceback' not in process.log
    assert 'truncated or of wrong length' in process.log
    msg = probe.tables[-1]
    track, flown = to_columns(msg, 9), seconds(msg.header.stamp) % DAY - start
    assert abs(track['x'][0] - (18520.0 + 18.52 * flown)) < 100.0  # plots have 1/256 NM
    assert abs(track['y'][0]) < 100.0


@pytest.mark.slow
def test_feed_that_publishes_nothing_says_what_comes(feed, probe):
    """Tracks of another category: who waits for plots reads of them, and need not end the feed."""
    process, port = feed
    probe.peer.wait_for_node('/asterix_feed', deadline=60.0)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as radar:
        said = 'nothing to publish yet; no reports: category 62'
        probe.peer.ask(
            lambda _: radar.sendto(bytes([62, 0, 5, 1, 2]), ('127.0.0.1', port)),
            lambda: said in process.log, 'a word on what comes', again=0.1, deadline=30.0,
        )  # fmt: skip


def test_damaged_time_does_not_hold_up_a_file(probe, ros_domain_id, tmp_path):
    """One of the reports seems five hours later: nobody waits so long for it, but for a reader."""
    path, heard = tmp_path / 'night.ast', []
    times = [1000.0 + 0.25 * turn for turn in range(8)]
    times[3] += 5 * 3600.0
    path.write_bytes(b''.join(datagram(time_of_day, 10.0) for time_of_day in times))
    command = [sys.executable, '-m', 'tracking_tools.asterix', str(path)]
    with NodeProcess(command, ros_domain_id, tmp_path / 'feed.log') as process:
        process.wait_for_line('as soon as somebody listens on /plots')
        probe.hear(PointCloud2, 'plots', heard)
        probe.spin_until(lambda: len(heard) == 8, 'all plots', 40.0)
        assert process.wait() == 0
