# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a live node draws is what a viewer has on its screen, and comes out as a picture."""

from pathlib import Path

from matplotlib.figure import Figure
import numpy as np
import pytest

from msg_adapters.brush import Brush
from msg_adapters.message_types import rclpy_types
from tracking_tools.marker_picture import draw, main, play
from tracking_tools.marker_shapes import draw_markers
from tracking_tools.screen import Screen
from tracking_tools.sensors import SENSORS

ROOT = Path(__file__).parents[2]
PARAMETERS = ROOT / 'config' / 'terminal_radar.yaml'


@pytest.fixture
def brush():
    """Return a maker of markers."""
    return Brush(rclpy_types().header(5.0, 'map'), rclpy_types())


def array_of(*markers):
    """Return them as one message."""
    return rclpy_types().MarkerArray(markers=list(markers))


def test_screen_keeps_what_rviz_would(brush):
    """ADD replaces by namespace and id, DELETE takes one, DELETEALL takes all."""
    screen = Screen()
    screen.take(array_of(brush.marker('id', 1, 'CUBE'), brush.marker('gate', 1, 'SPHERE')))
    screen.take(array_of(brush.marker('id', 1, 'ARROW'), brush.marker('gate', 1, 'DELETE')))
    ((key, marker),) = screen.markers.items()
    assert (key, marker.type, screen.stamp) == (('id', 1), marker.ARROW, (5, 0))
    screen.take(array_of(brush.marker('', 0, 'DELETEALL')))
    assert not screen.ids()


@pytest.mark.parametrize('kind', ['ARROW', 'CUBE', 'SPHERE', 'LINE_STRIP', 'TRIANGLE_LIST'])
def test_shape_is_drawn_where_the_marker_is(brush, kind):
    """A shape of 4 m by 2 m at (10, 20), turned to the north, covers what it should."""
    quarter = [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]
    points = {
        'LINE_STRIP': [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        'TRIANGLE_LIST': [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0]],
    }
    marker = brush.marker(
        'a', 1, kind, position=[10.0, 20.0, 0.0], turn=quarter, scale=[4.0, 2.0, 1.0],
        color=[1.0, 0.0, 0.0, 1.0], points=points.get(kind, ()),
    )  # fmt: skip
    axes = Figure().add_subplot()
    draw_markers(axes, [marker], 1.0)
    (artist,) = axes.get_children()[:1]
    box = artist.get_datalim(axes.transData) if kind in points else artist.get_extents()
    box = box if kind in points else box.transformed(axes.transData.inverted())
    north = (20.0, 24.0) if kind == 'ARROW' else (18.0, 22.0)
    np.testing.assert_allclose([box.y0, box.y1], north, atol=1e-6)
    assert abs(0.5 * (box.x0 + box.x1) - 10.0) < 1e-6


@pytest.mark.slow
def test_live_node_shows_its_tracks_and_no_others(cut_bag, tmp_path):
    """After 20 turns every track has its five shapes, and what was deleted is gone."""
    bag = cut_bag(20)
    screen = play(bag, PARAMETERS, SENSORS['radar'], np.inf, tmp_path / 'node.log')
    shapes = {space for space, _ in screen.markers}
    assert shapes == {'history', 'velocity', 'covariance', 'gate', 'id'}
    assert len(screen.markers) <= 5 * len(screen.ids())
    assert {
        int(m.text) for (space, _), m in screen.markers.items() if space == 'id'
    } == screen.ids()
    assert 5 <= len(screen.ids()) <= 20  # contacts of the scene; every false track was deleted
    draw(screen.markers.values(), tmp_path / 'a.png', 'markers', np.array([0.0, 0.0, 2e4]))
    assert (tmp_path / 'a.png').read_bytes().startswith(b'\x89PNG')


def test_recording_that_is_none_is_told(tmp_path, capsys):
    """No traceback."""
    arguments = [str(tmp_path / 'no'), '--params', str(PARAMETERS), '--output']
    assert main([*arguments, str(tmp_path / 'a.png')]) == 1
    assert 'no bag at' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('options', 'why'),
    [
        (
            ['--window', '0', '0', '0'],
            'must be X Y WIDTH, finite, with a width above 0 m, got 0 0',
        ),
        (['--output', 'file/picture.png'], 'file is no folder'),
    ],
)
def test_picture_that_cannot_be_drawn_is_told(options, why, tmp_path, monkeypatch, capsys):
    """Before the recording is played, in one line."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'file').write_text('')
    words = ['bag', '--params', str(PARAMETERS), '--output', 'picture.png', *options]
    assert main(words) == 1
    said = capsys.readouterr().err
    assert said.startswith('marker_picture: ')
    assert why in said
