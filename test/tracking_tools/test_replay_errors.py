# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what the replay command refuses, what it skips, and what it says."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from msg_adapters.message_types import NANOSECONDS
from tracking_tools import replay as replay_module
from tracking_tools.bags import BadBag, BagWriter, TYPESTORE
from tracking_tools.replay import main, replay
from tracking_tools.replay_topics import Topics
from tracking_tools.stopping import STOPPED

PARAMETERS = Path(__file__).parents[2] / 'config' / 'terminal_radar.yaml'
TRACKS = '/radar_tracker/tracks'
TURNS = 25


def test_replay_counts_and_skips_bad_messages(tmp_path, capsys, messages, plots_message):
    """Messages without a needed field, from long ago or cut short cost only themselves."""
    good = [plots_message(100.0 + 4.0 * k, range=[5e3, 7e3], azimuth=[0.1, 2.0]) for k in range(6)]
    bad = plots_message(109.0, range=[5e3], snr=[3.0])
    old = plots_message(50.0, range=[5e3], azimuth=[0.1])
    with BagWriter(tmp_path / 'clean') as bag:
        for k, msg in enumerate(good):
            bag.write('plots', msg, (200 + k) * NANOSECONDS)
    with BagWriter(tmp_path / 'bad') as bag:
        for k, msg in enumerate((*good[:3], bad, old, *good[3:])):
            bag.write('plots', msg, (200 + k) * NANOSECONDS)
        raw = bytes(TYPESTORE.serialize_cdr(good[0], good[0].__msgtype__))
        bag.write_raw('plots', good[0].__msgtype__, raw[:70], 300 * NANOSECONDS)
    summary = replay(tmp_path / 'bad', tmp_path / 'out')
    replay(tmp_path / 'clean', tmp_path / 'expected', quiet=True)
    assert summary.tables == 6
    assert summary.plots.messages == 9
    assert summary.plots.refused == {
        'missing field': 1, 'stamp behind time': 1, 'not readable': 1,
    }  # fmt: skip
    assert 'azimuth' in capsys.readouterr().err
    rows, expected = (messages(tmp_path / name, TRACKS) for name in ('out', 'expected'))
    for (_, table), (_, clean) in zip(rows, expected, strict=True):
        np.testing.assert_array_equal(table.data, clean.data)


def test_remapped_moves_topics_and_refuses_others():
    """Names become absolute; the output may be named with its node or relative to it."""
    topics = Topics.remapped(['plots:=radar/plots', '~/tracks:=/all', '/ownship:=odom'])
    assert topics == replace(Topics(), plots='/radar/plots', tracks='/all', ownship='/odom')
    for rule in ('plots=/a', 'plotz:=/a', 'plots:=', 'node:=/a'):
        with pytest.raises(BadBag, match='--remap takes FROM:=TO with FROM one of plots'):
            Topics.remapped([rule])


def test_replay_says_which_topics_there_are(cut_bag, tmp_path):
    """Somebody who named the wrong topic sees the right one, with its type."""
    topics = Topics.remapped(['plots:=/radar'])
    with pytest.raises(BadBag, match=r'no topic /radar; it has /plots \(sensor_msgs/msg/PointC'):
        replay(cut_bag(TURNS), tmp_path / 'out', topics=topics, quiet=True)
    assert list(tmp_path.iterdir()) == []


def test_tracks_do_not_go_where_plots_are(cut_bag, tmp_path, capsys):
    """A live node would hear its own tracks; nothing is left behind."""
    words = [str(cut_bag(TURNS)), '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    assert main([*words, '--remap', 'tracks:=/plots', '--quiet']) == 1
    assert 'replay: /plots is for plots, tracks cannot go there' in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize('name', ['ownship', 'acquire', 'truth'])
def test_rule_that_leads_nowhere_is_refused(cut_bag, tmp_path, capsys, name):
    """A slip of the pen in the name of own ship would track as if the sensor stood still."""
    words = [str(cut_bag(TURNS)), '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    page = ['--report', str(tmp_path / 'page.html')] if name == 'truth' else []
    assert main([*words, '--remap', f'{name}:=/odm', *page, '--quiet']) == 1
    said = capsys.readouterr().err
    assert f'has no topic /odm, to which {name} is remapped; it has /plots (' in said
    assert not (tmp_path / 'page.html').exists()


def test_replay_says_that_a_topic_has_another_type(tmp_path):
    """Plots that are no point clouds are not read at all."""
    with BagWriter(tmp_path / 'odd') as bag:
        bag.write('plots', TYPESTORE.types['std_msgs/msg/UInt32'](data=1), 5)
    with pytest.raises(BadBag, match='/plots is std_msgs/msg/UInt32, expected sensor_msgs'):
        replay(tmp_path / 'odd', tmp_path / 'out', quiet=True)


@pytest.mark.parametrize('damage', ['missing', 'empty', 'cut', 'garbled', 'chunk'])
def test_main_fails_in_words_for_a_damaged_bag(cut_bag, tmp_path, capsys, damage):
    """Exit code 1, one line that names the bag or the place, and no output left behind."""
    path = tmp_path / 'bag'
    if damage != 'missing':
        path.mkdir()
    if damage in ('cut', 'garbled', 'chunk'):
        (path / 'metadata.yaml').write_bytes((cut_bag(TURNS) / 'metadata.yaml').read_bytes())
        storage = bytearray((cut_bag(TURNS) / 'recording.mcap').read_bytes())
        noise = np.random.default_rng(3).integers(0, 256, 20_000, np.uint8).tobytes()
        if damage == 'garbled':
            storage[200:20_200] = noise
        if damage == 'chunk':
            storage[50:1050] = noise[:1000]
        end = len(storage) // 2 if damage == 'cut' else None
        (path / 'recording.mcap').write_bytes(storage[:end])
    assert (
        main([str(path), '--sensor', 'radar', '--output', str(tmp_path / 'out'), '--quiet']) == 1
    )
    said = capsys.readouterr().err.strip()
    assert said.startswith('replay: ')
    assert '\n' not in said
    assert not (tmp_path / 'out').exists()


def test_main_overwrites_nothing(cut_bag, tmp_path, capsys):
    """An output that exists stays as it is."""
    arguments = [str(cut_bag(TURNS)), '--sensor', 'radar', '--output', str(tmp_path), '--quiet']
    assert main(arguments) == 1
    assert 'exists already' in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ('arguments', 'match'),
    [
        (['--set', 'gate.probabilty=0.9'], 'did you mean gate.probability'),
        (['--set', 'gate.probability=2'], 'must be in'),
        (['--set', 'gate.probability'], 'takes name=value'),
        (['--remap', 'plots'], 'takes FROM:=TO'),
        (['--params', 'marine_rader'], 'did you mean marine_radar'),
        (['--sensor', 'lidar'], 'invalid choice'),
    ],
)
def test_main_refuses_bad_arguments(tmp_path, capsys, arguments, match):
    """Exit code 2 and what is wrong, before anything is read."""
    always = ['bag', '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    with pytest.raises(SystemExit) as stopped:
        main([*always, *arguments])
    assert stopped.value.code == 2
    assert match in capsys.readouterr().err


def test_main_sums_up_and_lets_settings_win(cut_bag, tmp_path, capsys, messages):
    """Counts of messages, plots and tracks; --set is stronger than the file."""
    arguments = ['--params', str(PARAMETERS), '--set', 'sensor.range_max=60000']
    output = ['--output', str(tmp_path / 'out'), '--remap', '~/tracks:=/found']
    assert main([str(cut_bag(TURNS)), '--sensor', 'radar', *arguments, *output]) == 0
    said = capsys.readouterr().out
    assert f'messages: {TURNS}, used: {TURNS}' in said
    assert 'plots, range beyond range_max = 60000' in said
    assert 'times real time' in said
    assert len(messages(tmp_path / 'out', '/found')) == TURNS


def test_replay_without_a_confirmed_track_says_what_came(tmp_path, capsys, plots_message):
    """Who asks for a page then reads the summary, has the picture, and reads why no page came."""
    with BagWriter(tmp_path / 'bad') as bag:
        for k in range(3):
            degrees = plots_message(100.0 + 4.0 * k, range=[5e3], azimuth=[90.0])
            bag.write('plots', degrees, (200 + k) * NANOSECONDS)
    made = {name: tmp_path / name for name in ('tracks', 'picture.png', 'page.html')}
    tracks, picture, page = map(str, made.values())
    words = ['--sensor', 'radar', '--output', tracks, '--picture', picture, '--report', page]
    assert main([str(tmp_path / 'bad'), *words]) == 1
    told = capsys.readouterr()
    assert 'refused: 3 messages' in told.out
    assert 'replay: no picture or page: ' in told.err
    assert [path.exists() for path in made.values()] == [True, True, False]


def test_interrupted_picture_leaves_the_tracks_and_says_where(
    cut_bag, tmp_path, capsys, monkeypatch
):
    """The bag is complete by then; who runs the command again must know of it."""

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(replay_module, '_show', interrupt)
    tracks = tmp_path / 'tracks'
    assert main([str(cut_bag(TURNS)), '--sensor', 'radar', '--output', str(tracks)]) == STOPPED
    assert capsys.readouterr().err.endswith(f'replay: stopped; the tracks are in {tracks}\n')
    assert (tracks / 'metadata.yaml').exists()


@pytest.mark.parametrize('azimuth', [[], [[90.0], [91.0]]], ids=['empty', 'refused'])
def test_replay_that_used_nothing_fails_also_when_quiet(tmp_path, capsys, plots_message, azimuth):
    """A script must notice."""
    with BagWriter(tmp_path / 'bad') as bag:
        bag.announce('plots', 'sensor_msgs/msg/PointCloud2')
        for k, degrees in enumerate(azimuth):
            bag.write('plots', plots_message(100.0 + k, range=[5e3], azimuth=degrees), k)
    words = [str(tmp_path / 'bad'), '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    assert main([*words, '--quiet']) == 1
    why = 'angles in degrees? (2)' if azimuth else 'there is none'
    assert capsys.readouterr().err == f'replay: no message of /plots could be used: {why}\n'


def test_recording_shorter_than_a_cycle_is_told_so(tmp_path, capsys, plots_message):
    """Its messages are there, but what they are parts of is not over."""
    with BagWriter(tmp_path / 'bag') as bag:
        bag.announce('bearings', 'sensor_msgs/msg/PointCloud2')
        for k in range(3):
            bag.write('bearings', plots_message(100.0 + k, bearing=[0.1]), k)
    words = [str(tmp_path / 'bag'), '--sensor', 'sonar', '--output', str(tmp_path / 'out')]
    assert main([*words, '--quiet', '--set', 'scan.period=60']) == 1
    assert capsys.readouterr().err.endswith('could be used: no scan is over\n')


def test_directory_that_is_no_bag_is_told_so(tmp_path, capsys):
    """In words of a user, not of a library."""
    words = [str(tmp_path), '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    assert main(words) == 1
    said = capsys.readouterr().err
    assert f'{tmp_path} is no rosbag2 recording: there is no metadata.yaml in it' in said


@pytest.mark.parametrize('odd', ['plots', 'truth'])
def test_pictures_and_pages_leave_out_what_replay_does(tmp_path, plots_message, odd):
    """A plots message cut short, a truth that is no table: both are drawn all the same."""
    with BagWriter(tmp_path / 'bag') as bag:
        for k in range(6):
            msg = plots_message(100.0 + 4.0 * k, range=[5e3, 7e3], azimuth=[0.1, 2.0])
            bag.write('plots', msg, (200 + k) * NANOSECONDS)
        if odd == 'plots':
            raw = bytes(TYPESTORE.serialize_cdr(msg, msg.__msgtype__))
            bag.write_raw('plots', msg.__msgtype__, raw[:70], 300 * NANOSECONDS)
        else:
            bag.write('truth', msg.header, 300 * NANOSECONDS)
    shown = ['--picture', str(tmp_path / 'p.png'), '--report', str(tmp_path / 'p.html')]
    given = [str(tmp_path / 'bag'), '--sensor', 'radar', '--output', str(tmp_path / 'out')]
    assert main([*given, *shown, '--quiet']) == 0
    assert (tmp_path / 'p.png').stat().st_size > 1000
    assert (tmp_path / 'p.html').stat().st_size > 1000
