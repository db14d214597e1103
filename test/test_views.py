# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""RViz and Foxglove show what the nodes publish: topics, namespaces and columns exist."""

import json
from pathlib import Path

import pytest

from msg_adapters import fans, markers

yaml = pytest.importorskip('yaml')
ROOT = Path(__file__).parent.parent
SPACES = {'radar': set(markers.NAMESPACES), 'sonar': set(fans.NAMESPACES)}
INPUTS = {'radar': {'/plots', '/ownship'}, 'sonar': {'/bearings', '/ownship'}}
SENSORS = sorted(SPACES)


def topics_of(sensor):
    """Return what a node of this sensor publishes or hears, by its name."""
    node = f'/{sensor}_tracker'
    return {f'{node}/{name}' for name in ('tracks', 'odometry', 'markers')} | INPUTS[sensor]


@pytest.mark.parametrize('sensor', SENSORS)
def test_rviz_shows_topics_that_exist(sensor):
    """Every display has a topic of the node, and every namespace of markers its switch."""
    view = yaml.safe_load((ROOT / 'rviz' / f'{sensor}.rviz').read_text())['Visualization Manager']
    displays = {shown['Name']: shown for shown in view['Displays']}
    named = {d['Topic']['Value'] for d in displays.values() if 'Topic' in d}
    assert f'/{sensor}_tracker/markers' in named
    assert named <= topics_of(sensor)
    assert set(displays['Tracks']['Namespaces']) == SPACES[sensor]
    assert displays['Tracks']['Enabled'] is True
    assert displays['Track table']['Channel Name'] == 'existence_probability'
    (point,) = (tool for tool in view['Tools'] if tool['Class'].endswith('PublishPoint'))
    assert point['Topic']['Value'] == '/acquire'
    classes = [d['Class'] for d in (*view['Displays'], *view['Tools'], view['Views']['Current'])]
    assert all(name.startswith('rviz_default_plugins/') for name in classes)


@pytest.mark.parametrize('sensor', SENSORS)
def test_foxglove_layout_shows_topics_that_exist(sensor):
    """Every panel of the layout is described, and its topics are those of the node."""
    layout = json.loads((ROOT / 'foxglove' / f'{sensor}.json').read_text())
    assert set(panels_of(layout['layout'])) == set(layout['configById'])
    scene = layout['configById']['3D!tracks']
    assert scene['topics'][f'/{sensor}_tracker/markers']['visible'] is True
    assert set(scene['topics']) <= topics_of(sensor)
    assert scene['publish']['pointTopic'] == '/acquire'
    assert layout['configById']['RawMessages!table']['topicPath'] in topics_of(sensor)


def panels_of(tree):
    """Yield the names of the panels in a layout."""
    if isinstance(tree, str):
        yield tree
    else:
        yield from panels_of(tree['first'])
        yield from panels_of(tree['second'])
