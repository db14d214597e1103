# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A node that is killed goes on with the same tracks where it is started again."""

import signal

import pytest

from msg_adapters.table import to_columns
from tracking_tools.testing import confirmed_ids

SIGINT, SIGKILL = signal.SIGINT, signal.SIGKILL
INTERVAL, STEP = 0.5, 0.01  # between two scans until one is answered [s], by clock and by stamps
MOST = 1000  # rows


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes."""
    return request.getfixturevalue(request.param)


def start_again(node, start_node, probe, parameters, number):
    """End a node by a signal, start it once more; return it and its first table."""
    node.signal(number)
    node.wait()
    node, heard = start_node(*parameters), len(probe.tables)

    def scan(_):
        probe.stamp += STEP  # however slow the start is, no jump of time
        probe.send(probe.sensor.contacts(probe.stamp), probe.stamp)

    probe.peer.ask(scan, lambda: len(probe.tables) > heard, 'an answer', INTERVAL)
    return node, to_columns(probe.tables[heard], MOST)


@pytest.mark.parametrize('number', [SIGKILL, SIGINT], ids=['kill', 'int'])
def test_tracks_go_on_after_a_restart(start_node, probe, sensor, tmp_path, number):
    """The same ids in the first table after it, and new tracks get ids that nobody had."""
    parameters = [f'snapshot.file:={tmp_path / "tracks"}', 'snapshot.period:=0.1']
    node = start_node(*parameters)
    probe.meet()
    before = confirmed_ids(probe.confirmed())
    if number == SIGKILL:  # the newest scan is in the file before the blow
        written = (tmp_path / 'tracks').stat().st_mtime_ns
        probe.scan()
        probe.spin_until(lambda: (tmp_path / 'tracks').stat().st_mtime_ns > written, 'snapshot')
    node, after = start_again(node, start_node, probe, parameters, number)
    node.wait_for_line('tracks of')
    assert before <= confirmed_ids(after)
    assert node.log.count('starts anew') == 0
    probe.reset()
    fresh = confirmed_ids(probe.confirmed())
    assert min(fresh) > 1000  # beyond all that the killed node could have given away


@pytest.mark.parametrize('sensor', ['radar'], indirect=True)
def test_snapshot_that_does_not_fit_is_refused_in_words(start_node, probe, sensor, tmp_path):
    """Of other parameters: said by name, tracking starts anew, and ids go on."""
    file = f'snapshot.file:={tmp_path / "tracks"}'
    node = start_node(file)
    probe.meet()
    before = confirmed_ids(probe.confirmed())
    node, _ = start_again(node, start_node, probe, [file, 'sensor.range_sd:=30.0'], SIGINT)
    line = node.wait_for_line('is not used')
    assert 'parameter sensor.range_sd was 50.0, and is 30.0 now' in line
    assert not before & confirmed_ids(probe.confirmed())
