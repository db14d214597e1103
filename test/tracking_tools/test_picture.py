# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what pictures show: which pieces of a scene, and that any scene can be drawn."""

from dataclasses import replace
from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.image import imread
import numpy as np
import pytest

from tracking_tools.highlights import (
    find_meeting,
    find_turning,
    holding_window,
    NAMED,
    place_labels,
    smooth_turn_rate,
    true_path,
)
from tracking_tools.panels import draw_plan
from tracking_tools.picture import draw
from tracking_tools.replay import replay
from tracking_tools.scene import choose, read_scene, Scene

PERIOD = 4.0


def path(number, x, y, vx, vy):
    """Return the rows of one track, a look every period."""
    n = len(x)
    time = PERIOD * np.arange(n)
    columns = {'x': x, 'y': y, 'vx': vx, 'vy': vy, 'z': np.zeros(n), 'time': time, 'stamp': time}
    more = {
        'id': np.full(n, number), 'course': np.arctan2(vy, vx), 'gate_x': np.full(n, 300.0),
        'gate_y': np.full(n, 200.0), 'manoeuvre_probability': np.full(n, 0.5),
    }  # fmt: skip
    return {name: np.asarray(values) for name, values in {**columns, **more}.items()}


def straight(number, start, velocity, looks=60):
    """Return a track that goes straight on."""
    time = PERIOD * np.arange(looks)
    x, y = (start[k] + velocity[k] * time for k in (0, 1))
    return path(number, x, y, np.full(looks, velocity[0]), np.full(looks, velocity[1]))


def racetrack(number, centre, looks=120, lead=0, speed=100.0):
    """Return a track that flies a minute straight and a minute in a turn, and so on."""
    turning = ((np.arange(looks) // 15) % 2 == 1) & (np.arange(looks) >= lead)
    course = np.cumsum(np.where(turning, np.radians(3.0) * PERIOD, 0.0))
    vx, vy = speed * np.cos(course), speed * np.sin(course)
    x, y = centre[0] + np.cumsum(vx) * PERIOD, centre[1] + np.cumsum(vy) * PERIOD
    return path(number, x, y, vx, vy)


def scene(*paths, truth=()):
    """Return a scene of these tracks, with a plot at each of their rows."""

    def join(parts):
        return {n: np.concatenate([p[n] for p in parts]) for n in parts[0]} if parts else {}

    tracks = join(paths)
    return Scene(plots=tracks, published=tracks, truth=join(truth))


def without_plots(drawn):
    """Return the scene as of a sensor that moves in the frame of the tracks."""
    return replace(drawn, plots={})


def test_smooth_turn_rate_is_the_rate_of_a_steady_turn():
    """Anticlockwise is positive, also where the course wraps."""
    course = np.radians(170.0) + np.radians(2.0) * PERIOD * np.arange(30)
    rows = path(1, course, course, np.cos(course), np.sin(course))
    np.testing.assert_allclose(smooth_turn_rate(rows), np.radians(2.0), rtol=1e-9)


def test_find_turning_prefers_turns_between_straight_legs():
    """Neither the track that only turns nor the one that never does is instructive."""
    course = np.radians(3.0) * PERIOD * np.arange(100)
    circle = path(7, 2e3 * np.sin(course), 2e3 * np.cos(course), np.cos(course), -np.sin(course))
    holding = racetrack(5, (30e3, 0.0))
    assert find_turning(scene(circle, straight(6, (0.0, 0.0), (100.0, 0.0)), holding)) == 5
    assert find_turning(scene()) is None


def test_true_path_is_that_of_the_contact_under_the_track():
    """The nearest contact is chosen; without a truth the track's own rows."""
    near, far = straight(1, (0.0, 100.0), (100.0, 0.0)), straight(2, (0.0, 9e3), (100.0, 0.0))
    track = straight(42, (0.0, 0.0), (100.0, 0.0))
    assert set(true_path(scene(track, truth=(near, far)), 42)['id']) == {1}
    assert set(true_path(scene(track), 42)['id']) == {42}


def test_holding_window_holds_the_turns():
    """The window has the asked shape and contains the track while it turned."""
    holding = racetrack(5, (30e3, -8e3), looks=300, lead=150)
    window = holding_window(scene(holding), 5, shape=1.5)
    assert window.half[0] == pytest.approx(1.5 * window.half[1])
    during = (holding['time'] >= window.start) & (holding['time'] <= window.end)
    assert window.shows(holding)[during].all()
    assert np.mean(smooth_turn_rate(choose(holding, during)) > np.radians(2.0)) > 0.4


def test_find_meeting_finds_the_closest_crossing():
    """Tracks side by side are no meeting; of two crossings the closer one is shown."""
    one = straight(1, (-12e3, 0.0), (100.0, 0.0))
    other = straight(2, (0.0, -12.5e3), (0.0, 100.0))
    beside = straight(3, (-12e3, 240.0), (100.0, -2.0))
    away = racetrack(5, (90e3, 0.0))
    found = find_meeting(scene(one, other, beside, away), 1.3, holding_window(scene(away), 5, 1.3))
    assert np.hypot(*found.centre) < 3e3
    assert found.start < 120.0 < found.end
    alone = scene(one, beside, away)
    assert find_meeting(alone, 1.3, holding_window(alone, 5, 1.3)) is None


def test_place_labels_keeps_labels_apart_and_on_their_tracks():
    """Two tracks side by side all the way have their labels far apart."""
    one = straight(1, (-24e3, 0.0), (100.0, 0.0))
    other = straight(2, (-24e3, 1e3), (100.0, 0.0))
    places = place_labels(scene(one, other).tracks)
    assert places.keys() == {1, 2}
    assert np.hypot(*np.subtract(places[1], places[2])) > 12e3
    assert np.min(np.hypot(one['x'] - places[1][0], one['y'] - places[1][1])) == 0.0


def test_place_labels_names_the_longest_tracks_of_many():
    """Of six hours 797 labels covered all else, and took two minutes."""
    tracks = [straight(k, (0.0, 1e3 * k), (100.0, 0.0), looks=30 + k % 50) for k in range(100)]
    places = place_labels(scene(*tracks).tracks)
    assert len(places) == NAMED
    assert min(30 + number % 50 for number in places) >= 30 + 50 - NAMED // 2


def test_near_scene_fills_plan_and_window():
    """A walk of 30 m: the plan was a kilometre wide, the closer look too."""
    walk = racetrack(5, (30.0, 0.0), speed=0.3)
    width = max(np.ptp(walk['x']), np.ptp(walk['y']))
    axes = Figure().add_subplot()
    draw_plan(axes, scene(walk))
    assert np.ptp(axes.get_xlim()) == pytest.approx(1.12 * width / 1e3)
    assert holding_window(scene(walk), 5, shape=1.0).half[0] < width


def test_draw_shows_the_demo_scene(cut_bag, tmp_path):
    """A picture 1600 pixels wide, small enough for a README, in more than a few colours."""
    replay(cut_bag(60), tmp_path / 'tracks', quiet=True)
    draw(read_scene(cut_bag(60), tmp_path / 'tracks'), tmp_path / 'new' / 'picture.png', 'Title')
    size = (tmp_path / 'new' / 'picture.png').stat().st_size
    pixels = imread(tmp_path / 'new' / 'picture.png')
    assert pixels.shape[1] == 1600
    assert len(np.unique(pixels[..., :3].reshape(-1, 3), axis=0)) > 50
    assert size < 500_000


@pytest.mark.parametrize(
    'drawn',
    [
        scene(),
        scene(straight(1, (0.0, 0.0), (0.0, 0.0), looks=1)),
        scene(straight(1, (0.0, 0.0), (0.0, 0.0), looks=40)),
        scene(straight(1, (-9e3, 0.0), (90.0, 0.0)), straight(2, (0.0, -9e3), (0.0, 90.0))),
        without_plots(scene(straight(1, (-9e3, 0.0), (90.0, 0.0)))),
    ],
    ids=['nothing', 'one look', 'at rest', 'without truth', 'without plots'],
)
def test_draw_copes_with_any_scene(drawn, tmp_path):
    """An empty scene, a single look, a contact at rest, tracks without a truth."""
    draw(drawn, tmp_path / 'picture.png')
    assert (tmp_path / 'picture.png').stat().st_size > 1000


def test_read_scene_leaves_out_what_is_not_there(cut_bag, tmp_path):
    """Times count from the beginning, tracks are confirmed ones, looks are not told twice."""
    replay(cut_bag(40), tmp_path / 'tracks', quiet=True)
    found = read_scene(cut_bag(40), tmp_path / 'tracks')
    assert found.has_truth
    assert 0.0 <= found.plots['time'].min() < 4.0
    assert set(found.published['status']) == {1}
    looks = np.stack([found.tracks['id'], found.tracks['time'].round(3)], axis=1)
    assert len(np.unique(looks, axis=0)) == len(looks)
    assert not read_scene(tmp_path / 'tracks', tmp_path / 'tracks').has_truth


def test_scene_tells_each_look_once():
    """A message that came before the antenna did repeats a row; the picture shows it once."""
    once = straight(1, (0.0, 0.0), (100.0, 0.0), looks=5)
    twice = {name: np.repeat(values, 2, axis=0) for name, values in once.items()}
    tracks = Scene(plots={}, published=twice, truth={}).tracks
    np.testing.assert_array_equal(tracks['time'], once['time'])


def test_readme_picture_is_small_and_sharp():
    """The picture that the project shows is what the demo makes, and loads quickly."""
    picture = Path(__file__).parents[2] / 'docs' / 'images' / 'demo.png'
    assert picture.stat().st_size <= 500_000
    assert imread(picture).shape[1] == 1600
