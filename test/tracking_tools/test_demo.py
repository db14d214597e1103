# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the demo as a user starts it, and how it ends when the user has seen enough."""

import os
from pathlib import Path
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from rosbags.typesys import get_typestore, Stores

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools import demo_sonar
from tracking_tools.bags import BagWriter, open_bag
from tracking_tools.demo import main, RADAR_DEMO
from tracking_tools.held import count_false, find_holds
from tracking_tools.node_process import NodeFailed, NodeProcess, private_domain, python_node
from tracking_tools.scene import Scene

ROOT = Path(__file__).parents[2]
DEADLINE = 60.0


def start(*arguments):
    """Start the demo as a process."""
    return subprocess.Popen(
        [sys.executable, '-m', 'tracking_tools.demo', *map(str, arguments)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def children(pid):
    """Return the processes that a process has started, and theirs."""
    found = []
    for status in Path('/proc').glob('[0-9]*/stat'):
        try:
            parent = int(status.read_text().rpartition(')')[2].split()[1])
        except (OSError, ValueError):
            continue
        if parent == pid:
            child = int(status.parent.name)
            found += [child, *children(child)]
    return found


def wait_for(condition, process):
    """Wait until the condition holds."""
    deadline = time.monotonic() + DEADLINE
    while not condition():
        assert process.poll() is None, process.communicate()[0]
        assert time.monotonic() < deadline
        time.sleep(0.05)  # between two looks, not for something to be over


@pytest.mark.slow
def test_demo_ends_with_tracks_and_a_picture(cut_bag, tmp_path):
    """The live node answers every message; the end says how long contacts were held."""
    process = start('--output', tmp_path, '--recording', cut_bag(40), '--rate', 1e6)
    said, _ = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0, said
    assert 'of the time' in said
    assert '0 id switches' in said
    assert (tmp_path / 'demo.png').read_bytes().startswith(b'\x89PNG')
    assert '<title>turns_40</title>' in (tmp_path / 'demo.html').read_text()
    with open_bag(tmp_path / 'demo_tracks') as bag:
        chosen = [c for c in bag.connections if c.topic == '/radar_tracker/tracks']
        tables = [
            to_columns(bag.deserialize(raw, c.msgtype), 1000) for c, _, raw in bag.messages(chosen)
        ]
    assert len(tables) == 40
    assert np.sum(tables[-1]['status'] == 1) >= 5


@pytest.mark.parametrize('live', [[], ['--no-live']], ids=['live', 'replay'])
def test_demo_plays_a_recording_with_other_topics(live, cut_bag, tmp_path, capsys):
    """As the tutorial says, by the rule of replay; the node listens on its own topic."""
    with BagWriter(tmp_path / 'bag') as out, open_bag(cut_bag(10)) as bag:
        for connection, received, raw in bag.messages():
            out.write_raw(f'/site{connection.topic}', connection.msgtype, raw, received)
    given = ['--recording', str(tmp_path / 'bag'), '--output', str(tmp_path), '--rate', '1e6']
    assert main([*given, *live]) == 1
    assert 'with --remap plots:=/TOPIC' in capsys.readouterr().err
    rules = ['--remap', 'plots:=/site/plots', '--remap', 'truth:=/site/truth']
    assert main([*given, *live, *rules]) == 0
    assert 'aircraft were held' in capsys.readouterr().out
    with open_bag(tmp_path / 'demo_tracks') as bag:
        assert bag.topics['/radar_tracker/tracks'].msgcount == 10


def test_demo_plays_plots_of_another_type(tmp_path):
    """The node is told which: it is not sent the bytes of a LaserScan as those of a cloud."""
    types = rosbags_types()
    with BagWriter(tmp_path / 'bag') as out:
        for second in range(1, 6):
            ranges = np.full(360, np.inf, np.float32)
            ranges[[40, 200]] = 60.0, 30.0
            msg = get_typestore(Stores.ROS2_JAZZY).types['sensor_msgs/msg/LaserScan'](
                types.Header(types.Time(second, 0), 'laser'), -np.pi, np.pi, np.pi / 180.0, 0.0,
                1.0, 1.0, 100.0, ranges, np.zeros(0, np.float32),
            )  # fmt: skip
            out.write('plots', msg, second * 10**9)
    given = ['--recording', str(tmp_path / 'bag'), '--output', str(tmp_path), '--rate', '1e6']
    assert main([*given, '--params', str(ROOT / 'config' / 'harbour_radar.yaml')]) == 0
    with open_bag(tmp_path / 'demo_tracks') as bag:
        assert bag.topics['/radar_tracker/tracks'].msgcount == 5


@pytest.mark.slow
@pytest.mark.parametrize('request_', [signal.SIGINT, signal.SIGTERM])
def test_demo_stops_when_asked(cut_bag, tmp_path, request_):
    """No traceback, no node left behind, no half-written bag."""
    process = start('--output', tmp_path, '--recording', cut_bag(40), '--rate', 1.0)
    log = tmp_path / 'demo_node.log'
    wait_for(lambda: log.exists() and 'fields of the plots' in log.read_text(), process)
    started = children(process.pid)
    assert started
    os.killpg(process.pid, request_)  # as a terminal does
    said, _ = process.communicate(timeout=DEADLINE)
    assert process.returncode == 130
    assert 'Traceback' not in said + log.read_text()
    assert [path.name for path in tmp_path.iterdir()] == ['demo_node.log']
    assert not any(Path(f'/proc/{child}').exists() for child in started)


def test_demo_without_a_node_gives_the_same_files(cut_bag, tmp_path, capsys):
    """A replay stands in where there is no ROS; a second run replaces the first."""
    arguments = ['--no-live', '--output', str(tmp_path), '--recording', str(cut_bag(40))]
    for _ in range(2):
        assert main(arguments) == 0
    assert 'of the time' in capsys.readouterr().out
    assert {path.name for path in tmp_path.iterdir()} == {
        'demo.html',
        'demo.png',
        'demo_tracks',
    }


def test_demo_removes_nothing_but_bags(cut_bag, tmp_path, capsys):
    """A folder of somebody else in the place of the bag stays."""
    (tmp_path / 'demo_tracks').mkdir()
    (tmp_path / 'demo_tracks' / 'thesis.txt').write_text('years of work')
    arguments = ['--no-live', '--output', str(tmp_path), '--recording', str(cut_bag(40))]
    assert main(arguments) == 1
    assert 'is in the way' in capsys.readouterr().err
    assert (tmp_path / 'demo_tracks' / 'thesis.txt').exists()


@pytest.mark.parametrize('demo', [RADAR_DEMO, demo_sonar.DEMO], ids=lambda demo: demo.name)
def test_demo_is_called_what_it_is(demo, capsys):
    """Its help names the command."""
    with pytest.raises(SystemExit):
        main(['--help'], demo)
    assert capsys.readouterr().out.startswith(f'usage: {demo.name} ')


@pytest.mark.parametrize('rate', ['0', '-1', 'nan', 'inf', 'fast'])
def test_demo_refuses_bad_rates(rate, capsys):
    """A rate is above zero."""
    with pytest.raises(SystemExit):
        main(['--rate', rate])
    assert f'--rate: must be a number above 0, got {rate}' in capsys.readouterr().err


def test_demo_says_that_its_folder_is_a_file(tmp_path, capsys):
    """In words, not as an errno."""
    (tmp_path / 'notes').write_text('years of work')
    assert main(['--no-live', '--output', str(tmp_path / 'notes')]) == 1
    assert 'notes is in the way, and is no folder' in capsys.readouterr().err


@pytest.mark.slow
def test_demo_says_why_the_node_does_not_start(cut_bag, tmp_path, capsys):
    """A parameter out of its range ends the node; its last words are shown."""
    params = tmp_path / 'bad.yaml'
    params.write_text('/**:\n  ros__parameters: {gate.probability: 7.0}\n')
    arguments = ['--output', str(tmp_path / 'out'), '--recording', str(cut_bag(40))]
    assert main([*arguments, '--params', str(params)]) == 1
    said = capsys.readouterr().err
    assert 'the node ended with code 1' in said
    assert 'gate.probability' in said


@pytest.mark.parametrize(('pid', 'first', 'second'), [(700, 1, 2), (798, 99, 100), (799, 100, 1)])
def test_private_domain_is_never_shared(pid, first, second, tmp_path, monkeypatch):
    """Two users at a time have two domains, and a free one is used again."""
    monkeypatch.setattr('tempfile.tempdir', str(tmp_path))  # no test beside this one takes any
    monkeypatch.setattr('os.getpid', lambda: pid)
    with private_domain() as one, private_domain() as another:
        assert (one, another) == (first, second)
    with private_domain() as again:
        assert again == first


def test_node_process_insists(tmp_path, monkeypatch):
    """A process that is deaf to SIGINT is ended all the same."""
    module = tmp_path / 'deaf.py'
    module.write_text(
        'import signal, time\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\n'
        'print("ready", flush=True)\nsignal.pause()\n'
    )
    log = tmp_path / 'log'
    monkeypatch.setenv('PYTHONPATH', str(tmp_path))
    process = NodeProcess(python_node('deaf'), 1, log, patience=0.2)
    with process:
        process.wait_for_line('ready')
        process.check()
    assert process.exit_code == -signal.SIGTERM
    with pytest.raises(NodeFailed, match='ended with code -15'):
        process.check()


def scene(truth, tracks):
    """Return a scene from rows (id, stamp, x); nothing moves in y and z."""
    names = ('x', 'y', 'z', 'vx', 'vy', 'vz')

    def columns(rows):
        ids, stamps, x = (np.array(values) for values in zip(*rows, strict=True))
        zero = dict.fromkeys(names, np.zeros(len(ids)))
        times = {'time': stamps.astype(float), 'stamp': stamps.astype(float)}
        return {**zero, **times, 'id': ids, 'x': x.astype(float)}

    published = columns(tracks)
    published['covariance'] = np.tile(np.eye(6).ravel(), (len(tracks), 1))
    return Scene(plots={}, published=published, truth=columns(truth))


def test_find_holds_counts_switches_in_sight_and_out_of_it():
    """A change of id counts apart when the contact was away; the first looks do not count."""
    seen = [k for k in range(40) if not 20 <= k < 27]
    truth = [(1, k, 0.0) for k in seen]
    tracks = [(5, k, 30.0) for k in range(4, 10)] + [(6, k, 40.0) for k in range(10, 20)]
    tracks += [(7, k, 0.0) for k in range(28, 40)] + [(8, k, 9e4) for k in range(3)]
    found = scene(truth, tracks)
    (hold,) = find_holds(found)
    assert hold.tracks.tolist() == [5, 6, 7]
    assert (hold.switches, hold.returns) == (1, 1)
    assert hold.share == pytest.approx(28 / 30)
    assert hold.error == pytest.approx(np.sqrt((6 * 30**2 + 10 * 40**2) / 28))
    assert count_false(found, [hold]) == 1
