# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The SROS2 policy allows what the running nodes do, and nothing else."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

POLICY = Path(__file__).parents[2] / 'policies' / 'contact_tracking.policy.xml'


@pytest.fixture(params=['radar', 'sonar'])
def sensor(request):
    """Test both nodes."""
    return request.getfixturevalue(request.param)


def allowed(node, access):
    """Return the full names that the policy gives a node an access to."""
    profile = ElementTree.parse(POLICY).find(f'.//profile[@node="{node}"]')
    names = [element.text for element in profile.iterfind(f'*[@{access}="ALLOW"]/*')]
    assert len(set(names)) == len(names)
    return {name.replace('~', f'/{node}') if name[0] in '~/' else f'/{name}' for name in names}


def test_policy_equals_the_graph_of_the_node(start_node, probe, sensor):
    """Topics both ways and services, by name; no client of anything."""
    start_node()
    probe.meet()
    node, graph = sensor.node, probe.node
    probe.peer.wait_for_node(f'/{node}')

    def is_equal():
        there = {
            'subscribe': graph.get_subscriber_names_and_types_by_node(node, '/'),
            'publish': graph.get_publisher_names_and_types_by_node(node, '/'),
            'reply': graph.get_service_names_and_types_by_node(node, '/'),
        }
        return all({name for name, _ in names} == allowed(node, access)
                   for access, names in there.items())  # fmt: skip

    probe.spin_until(is_equal, 'the graph of the policy')
    assert graph.get_client_names_and_types_by_node(node, '/') == []
