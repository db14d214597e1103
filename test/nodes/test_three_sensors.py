# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Two radars and an array in one graph, as launch/three_sensors.launch.py starts them."""

from contextlib import ExitStack
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest

from tracking_tools.testing import NodeProcess, python_node, RADAR, SONAR, TrackerProbe

ROOT = Path(__file__).parents[2]
SHARED = {'/diagnostics', '/rosout', '/parameter_events', '/ownship'}


def two_flights(stamp):
    """Return the plots of all but one of the synthetic flights."""
    return {name: values[:2] for name, values in RADAR.contacts(stamp).items()}


SENSORS = {
    'air_radar': replace(RADAR, frame='masthead'),
    'navigation_radar': replace(RADAR, frame='bridge', contacts=two_flights, count=2),
    'array': replace(SONAR, frame='array'),
}


@pytest.fixture
def probes(ros_domain_id, tmp_path):
    """Start a tracker in each namespace, and meet it."""
    with ExitStack() as running:
        probes = {}
        for name, sensor in SENSORS.items():
            command = python_node(
                f'{sensor.node}.node', '-r', f'__ns:=/ship/{name}', '-r', 'ownship:=/ownship'
            )
            log = tmp_path / name
            node = running.enter_context(NodeProcess(command, ros_domain_id, log, folder=ROOT))
            probe = TrackerProbe(ros_domain_id, sensor, f'ship/{name}', node.check)
            probes[name] = running.enter_context(probe)
        for probe in probes.values():
            probe.meet()
        yield probes


def names_of(probe):
    """Return the topics and services of a probe's tracker."""
    node, place = probe.sensor.node, probe.node.get_namespace()
    graph = probe.node
    probe.peer.wait_for_node(f'{place}/{node}')
    return {
        name
        for ask in (
            graph.get_subscriber_names_and_types_by_node,
            graph.get_publisher_names_and_types_by_node,
            graph.get_service_names_and_types_by_node,
        )
        for name, _ in ask(node, place)
    }


def test_three_sensors_do_not_meet(probes):
    """Each has its own names, its own tracks in its own frame, and its own diagnostics."""
    tables = {name: probe.confirmed(20) for name, probe in probes.items()}
    for name, probe in probes.items():
        assert (tables[name]['status'] == 1).sum() == SENSORS[name].count
        frames = {msg.header.frame_id for msg in probe.tables}
        assert frames == {SENSORS[name].frame}
        probe.spin_until(lambda p=probe: p.diagnosed('tracks confirmed') == str(p.sensor.count))
    names = [names_of(probe) for probe in probes.values()]
    assert all(len(each) > 15 for each in names)
    for one, other in combinations(names, 2):
        assert one & other <= SHARED
    wanted = {f'ship/{name}/{sensor.node}: tracking' for name, sensor in SENSORS.items()}
    heard = probes['array'].diagnostics
    probes['array'].spin_until(
        lambda: wanted <= {msg.status[0].name for msg in heard}, 'diagnostics of all three'
    )
    assert {msg.status[0].name for msg in heard} == wanted
