# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What docs/troubleshooting.md says that a node prints is what a node prints."""

from pathlib import Path
import re

import numpy as np
import pytest

from tracking_tools.testing import TrackerProbe

PAGE = Path(__file__).parents[2] / 'docs' / 'troubleshooting.md'
OF_NODES = (
    'nothing has come', 'there is no parameter', 'no parameters from', 'cannot', 'header.stamp of',
)  # fmt: skip


def normal(line):
    """Return a line without its prefix, its numbers, and the side on which the clock is."""
    text = re.sub(r'^\[.*\]: ', '', line.strip()).replace('ahead of the clock', 'behind the clock')
    return re.sub(r'-?\d+(\.\d+)?', '0', text)


@pytest.mark.slow
def test_lines_of_the_page_are_those_that_nodes_print(start_node, ros_domain_id, sensor, tmp_path):
    """Every mistake of the page that only a process can tell, once."""
    (tmp_path / 'my_radar.yaml').write_text('/radar:\n  ros__parameters: {max_plots: 9}\n')
    file = ['--params-file', str(tmp_path / 'my_radar.yaml')]
    nodes = [
        start_node('sensor.range_sdd:=3.0', arguments=file),
        start_node('use_sim_time:=true'),
        start_node('sensor.detection_probability:=1.5'),
        start_node('input_type:=radar_msgs/RadarScan'),
        start_node(arguments=['--params-file', str(tmp_path / 'marine_radar')]),
    ]
    for node in nodes[:2]:
        node.wait_for_line('nothing has come')
    assert [node.wait() for node in nodes[2:]] == [1, 1, 1]
    with TrackerProbe(ros_domain_id, sensor) as probe:
        probe.peer.wait_until_matched(probe.plots)

        def is_told():
            probe.send({'range': np.ones(1), 'azimuth': np.ones(1)}, probe.stamp)
            return 'header.stamp of' in nodes[0].log

        probe.spin_until(is_told, 'a word on the clock')
    said = ''.join(node.log for node in nodes).replace(f'{tmp_path}/', '')
    printed = [line for line in PAGE.read_text().splitlines() if line.startswith(OF_NODES)]
    assert len(printed) == 8
    assert {normal(line) for line in printed} <= {normal(line) for line in said.splitlines()}
