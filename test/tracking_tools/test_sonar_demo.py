# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what the array hears, how it is replayed and drawn, and what the sonar's demo says."""

from dataclasses import replace
import math
from pathlib import Path

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools.bags import BadBag, BagWriter, nanoseconds, open_bag
from tracking_tools.bearing_picture import draw
from tracking_tools.bearing_scene import BearingScene, read_bearing_scene
from tracking_tools.crossings import find_crossings, find_hearings
from tracking_tools.demo import main as demo_main
from tracking_tools.demo_sonar import DEMO, PARAMETERS, record
from tracking_tools.replay import main, read_configs
from tracking_tools.replay_topics import Topics
from tracking_tools.scenarios.listening import listen
from tracking_tools.scenarios.messages import EPOCH
from tracking_tools.scenarios.watches import long_watch, v0
from tracking_tools.sensors import SENSORS

SONAR = SENSORS['sonar']
TOPICS = Topics.of(SONAR)
PNG = b'\x89PNG'


@pytest.fixture(scope='module')
def heard(tmp_path_factory):
    """Record four minutes of the demo's watch."""
    path = tmp_path_factory.mktemp('heard') / 'bag'
    with BagWriter(path) as bag:
        for sent in listen(replace(long_watch(), duration=240.0), rosbags_types()):
            for topic, msg, time in sent:
                bag.write(topic, msg, nanoseconds(EPOCH + time))
    return path


def tables_of(bag):
    """Return all track tables of a bag."""
    with open_bag(bag) as reader:
        chosen = [c for c in reader.connections if c.topic == TOPICS.tracks]
        return [
            to_columns(reader.deserialize(raw, c.msgtype), 1000)
            for c, _, raw in reader.messages(chosen)
        ]


def replayed(heard, folder, *more):
    """Replay and return the tracks bag."""
    tracks = folder / 'tracks'
    arguments = [heard, '--sensor', 'sonar', '--params', PARAMETERS, '--output', tracks, *more]
    assert main([*map(str, arguments), '--quiet']) == 0
    return tracks


def test_v0_has_the_facts_of_the_paper():
    """Separation at 1000 s, and where and when the bearings cross."""
    watch = v0()
    time = np.arange(0.0, 1850.0, 0.1)
    own, _ = watch.own.at(time)
    line = [contact.trajectory.at(time)[0] - own for contact in watch.contacts]
    bearing = [np.degrees(np.arctan2(part[:, 0], part[:, 1])) for part in line]
    apart = bearing[0] - bearing[1]
    assert apart[10_000] == pytest.approx(2.344, abs=0.005)
    cross = int(np.argmin(np.abs(apart)))
    assert time[cross] == pytest.approx(1332.6, abs=0.5)
    assert bearing[0][cross] == pytest.approx(75.43, abs=0.02)


def test_marks_are_where_the_contacts_are(heard):
    """Turned by own ship, nine marks in ten of each contact's cycles are within its noise."""
    configs = read_configs(PARAMETERS, {}, SONAR)
    scene = read_bearing_scene(heard, heard, TOPICS, configs[0].sensor, {})
    for number in (1, 2, 3):
        path = {k: v[scene.truth['id'] == number] for k, v in scene.truth.items()}
        true = np.interp(scene.marks['time'], path['time'], path['bearing'])
        near = np.abs(scene.marks['bearing'] - true) < math.radians(1.0)
        assert near.sum() > 0.9 * len(path['time'])


def test_replay_of_a_sonar_is_deterministic_and_draws(heard, tmp_path):
    """The same bytes twice; all three contacts are confirmed; a picture on request."""
    picture = tmp_path / 'picture.png'
    one = replayed(heard, tmp_path / 'one', '--picture', picture)
    two = replayed(heard, tmp_path / 'two')
    files = [next(path.glob('*.mcap')).read_bytes() for path in (one, two)]
    assert files[0] == files[1]
    tables = tables_of(one)
    assert len(tables) == 120
    assert np.sum(tables[-1]['status'] == 1) == 3
    assert not tables[-1]['observable'].any()  # own ship has not turned
    assert picture.read_bytes().startswith(PNG)


def test_topics_of_a_sonar_have_its_names():
    """Rules are those of its node."""
    assert (TOPICS.plots, TOPICS.tracks) == ('/bearings', '/sonar_tracker/tracks')
    topics = Topics.remapped(['bearings:=array/marks', '~/tracks:=/all'], SONAR)
    assert (topics.plots, topics.tracks) == ('/array/marks', '/all')
    with pytest.raises(BadBag, match='one of bearings'):
        Topics.remapped(['plots:=/radar'], SONAR)


def test_bag_without_bearings_is_refused_by_name(tmp_path, capsys, heard):
    """The message says what to write."""
    arguments = [heard, '--sensor', 'sonar', '--remap', 'bearings:=/other', '--output', tmp_path]
    assert main([str(a) for a in arguments] + ['--quiet']) == 1
    assert '--remap bearings:=/TOPIC' in capsys.readouterr().err


def test_demo_without_a_node_tells_and_draws(heard, tmp_path, capsys):
    """Each contact with its track; the picture is small enough to be shown."""
    arguments = ['--no-live', '--output', tmp_path, '--recording', heard]
    assert demo_main([str(a) for a in arguments], DEMO) == 0
    said = capsys.readouterr().out
    assert 'not observable' in said
    files = {f'demo_sonar{end}' for end in ('.html', '.png', '_tracks')}
    assert {path.name for path in tmp_path.iterdir()} == files
    assert (tmp_path / 'demo_sonar.png').stat().st_size < 400_000


@pytest.mark.slow
def test_demo_plays_own_ship_and_marks_to_the_live_node(heard, tmp_path):
    """The live node's tables are those of the replay, row by row."""
    arguments = ['--output', tmp_path, '--recording', heard, '--rate', 1e6]
    assert demo_main([str(a) for a in arguments], DEMO) == 0
    live, again = tables_of(tmp_path / 'demo_sonar_tracks'), tables_of(replayed(heard, tmp_path))
    assert len(live) == len(again)
    np.testing.assert_array_equal(live[-1]['id'], again[-1]['id'])
    np.testing.assert_allclose(live[-1]['bearing'], again[-1]['bearing'], atol=1e-5)


def test_demo_makes_its_recording_anew(tmp_path, monkeypatch):
    """A bag with marks, own ship and the truth."""
    short = replace(long_watch(), duration=10.0)
    monkeypatch.setattr('tracking_tools.demo_sonar.long_watch', lambda: short)
    record(tmp_path / 'bag')
    with open_bag(tmp_path / 'bag') as bag:
        counts = {name: topic.msgcount for name, topic in bag.topics.items()}
    assert counts == {'/bearings': 5, '/ownship': 5, '/truth': 5}


def lines(*bearings):
    """Return tracks over 100 cycles, each from one bearing to another [deg]."""
    time, columns = np.arange(100.0), {name: [] for name in ('id', 'bearing', 'time')}
    for number, (start, end) in enumerate(bearings, 1):
        columns['id'].append(np.full(100, number))
        columns['bearing'].append(np.radians(np.linspace(start, end, 100)))
        columns['time'].append(time)
    rows = {name: np.concatenate(parts) for name, parts in columns.items()}
    zero = np.zeros(len(rows['id']))
    told = {'bearing_sd': zero + 1e-3, 'range': zero, 'range_sd': zero, 'observable': zero}
    return {**rows, 'stamp': rows['time'], **told}


def test_crossing_is_found_also_across_the_wrap():
    """Two that change sides, not one that comes near."""
    (crossing,) = find_crossings(lines((170.0, 190.0), (190.0, 170.0), (100.0, 90.0)), 0.03)
    assert crossing.ids == (1, 2)
    assert crossing.time == pytest.approx(50.0, abs=1.0)
    assert abs(math.remainder(crossing.bearing - math.pi, 2.0 * math.pi)) < 0.01
    assert find_crossings(lines((10.0, 11.0), (13.0, 12.0)), 0.03) == []


def test_hearing_counts_the_track_that_is_nearest():
    """Bearing error is root mean square; the track of another that passes by does not count."""
    truth, tracks = lines((10.0, 20.0), (15.0, 15.0)), lines((10.1, 20.1), (80.0, 80.0))
    truth['range'] = np.full(200, 1e3)
    first, second = find_hearings(BearingScene({}, tracks, truth, {}))
    assert (first.tracks, second.tracks) == ((1,), ())
    assert first.error == pytest.approx(math.radians(0.1), rel=1e-4)
    assert (first.share, second.share) == (1.0, 0.0)


@pytest.mark.parametrize('count', [0, 1, 2])
def test_picture_is_drawn_whatever_there_is(tmp_path, count):
    """Without truth, own ship, crossings, marks or even tracks."""
    tracks = lines(*[(170.0, 190.0), (190.0, 170.0)][:count]) if count else {}
    marks = {'time': np.zeros(1), 'bearing': np.ones(1), 'snr': np.full(1, np.nan)}
    path = Path(tmp_path, 'picture.png')
    draw(BearingScene(marks if count else {}, tracks, {}, {}), path)
    assert path.read_bytes().startswith(PNG)


def test_truth_of_another_bag_is_seen_from_the_ship_in_it(heard, tmp_path):
    """With the tracks alone as recording, which have no own ship, bearings are the same."""
    tracks = replayed(heard, tmp_path)
    sensor = read_configs(PARAMETERS, {}, SONAR)[0].sensor
    whole = read_bearing_scene(heard, tracks, TOPICS, sensor, {})
    alone = read_bearing_scene(tracks, tracks, TOPICS, sensor, {}, truth=heard)
    np.testing.assert_allclose(alone.truth['bearing'], whole.truth['bearing'], atol=1e-12)
    assert np.ptp(whole.truth['bearing']) > 0.1
