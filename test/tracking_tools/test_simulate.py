# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the simulate command: its bag and its complaints."""

import numpy as np
import pytest
from rosbags.typesys import TypesysError

from msg_adapters.table import to_columns
from tracking_tools.bags import absolute, BagWriter, nanoseconds, open_bag, TYPESTORE
from tracking_tools.scenarios import build, plots
from tracking_tools.scenarios.messages import EPOCH
from tracking_tools.simulate import main

MANY_ROWS = 10_000


def read(bag):
    """Messages of a bag by topic: (bag time [ns], header, columns)."""
    found = {}
    with open_bag(bag) as reader:
        for connection, stamp, raw in reader.messages():
            msg = reader.deserialize(raw, connection.msgtype)
            row = (stamp, msg.header, to_columns(msg, MANY_ROWS))
            found.setdefault(connection.topic, []).append(row)
    return found


def stamp_of(header):
    """Header stamp [ns]."""
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


@pytest.fixture(scope='module')
def turns_bag(tmp_path_factory):
    """Bag of 40 s of scenario turns."""
    bag = tmp_path_factory.mktemp('simulate') / 'turns'
    assert main(['turns', '--output', str(bag), '--duration', '40', '--seed', '5']) == 0
    return bag


def test_bag_has_a_plots_message_at_the_end_of_each_turn(turns_bag):
    """Columns, their types, stamp at the start of the turn, bag time at its end."""
    messages = read(turns_bag)['/plots']
    assert len(messages) == 10
    for k, (stamp, header, columns) in enumerate(messages):
        assert header.frame_id == 'radar'
        assert stamp_of(header) == nanoseconds(EPOCH + 4.0 * k)
        assert stamp == nanoseconds(EPOCH + 4.0 * (k + 1))
        assert list(columns) == ['range', 'azimuth', 'snr', 'time']
        assert {column.dtype for column in columns.values()} == {np.dtype('f4')}
        assert np.all((columns['time'] >= 0.0) & (columns['time'] <= 4.0))


def test_bag_rows_equal_the_simulated_columns(tmp_path):
    """Every plot of the scenario is in the bag, to float32."""
    scenario = build('terminal')
    bag = tmp_path / 'terminal'
    main(['terminal', '--output', str(bag)])
    scans = list(plots(scenario, np.random.default_rng(scenario.seed)))
    for scan, (_, _, columns) in zip(scans, read(bag)['/plots'], strict=True):
        assert list(columns) == ['range', 'azimuth', 'elevation', 'snr', 'time']
        for name, column in columns.items():
            exact = scan.columns[name] - (scan.start if name == 'time' else 0.0)
            np.testing.assert_array_equal(column, exact.astype('f4'))


def test_truth_has_a_row_for_each_pass_in_the_turn(turns_bag):
    """Six contacts in ten turns, ids 1 to 6, where their trajectories are at that time."""
    contacts = {contact.id: contact.trajectory for contact in build('turns').contacts}
    messages = read(turns_bag)['/truth']
    assert len(messages) == 10
    for k, (_, header, columns) in enumerate(messages):
        assert list(columns) == ['id', 'x', 'y', 'z', 'vx', 'vy', 'vz', 'time']
        assert columns['id'].dtype == np.dtype('u4')
        assert stamp_of(header) == nanoseconds(EPOCH + 4.0 * k)
        assert sorted(columns['id']) == [1, 2, 3, 4, 5, 6]
        for row, number in enumerate(columns['id']):
            position, velocity = contacts[number].at(4.0 * k + columns['time'][row])
            there = [columns[name][row] for name in ('x', 'y', 'z')]
            moving = [columns[name][row] for name in ('vx', 'vy', 'vz')]
            np.testing.assert_allclose(there, position, atol=0.01)
            np.testing.assert_allclose(moving, velocity, atol=0.01)


def test_bag_is_the_same_to_the_byte(tmp_path, turns_bag):
    """Twice the same seed gives the same files, under another name too; another seed does not."""
    again, other = tmp_path / 'again', tmp_path / 'other'
    main(['turns', '--output', str(again), '--duration', '40', '--seed', '5'])
    main(['turns', '--output', str(other), '--duration', '40', '--seed', '6'])
    files = sorted(path.name for path in turns_bag.iterdir())
    assert files == ['metadata.yaml', 'recording.mcap']
    for name in files:
        assert (again / name).read_bytes() == (turns_bag / name).read_bytes()
    assert (other / files[1]).read_bytes() != (turns_bag / files[1]).read_bytes()


def test_sectors_are_messages_of_their_own(tmp_path, turns_bag):
    """Four sectors: four times the plots messages, the same rows, the truth still once a turn."""
    bag = tmp_path / 'sectors'
    main(['turns', '--output', str(bag), '--duration', '40', '--seed', '5', '--sectors', '4'])
    whole, cut = read(turns_bag), read(bag)
    assert [len(cut[topic]) for topic in ('/plots', '/truth')] == [40, 10]
    assert stamp_of(cut['/plots'][1][1]) == nanoseconds(EPOCH + 1.0)
    ranges = [np.concatenate([row[2]['range'] for row in bag['/plots']]) for bag in (whole, cut)]
    np.testing.assert_array_equal(*ranges)
    np.testing.assert_array_equal(whole['/truth'][3][2]['x'], cut['/truth'][3][2]['x'])


def test_bag_offers_reliable_topics_of_the_right_type(turns_bag):
    """A player finds type, definition and quality of service in the bag."""
    with open_bag(turns_bag) as reader:
        for connection in reader.connections:
            assert connection.msgtype == 'sensor_msgs/msg/PointCloud2'
            (qos,) = connection.ext.offered_qos_profiles
            assert (qos.reliability.name, qos.durability.name) == ('RELIABLE', 'VOLATILE')
            assert (qos.history.name, qos.depth) == ('KEEP_LAST', 10)


def test_bag_messages_are_those_of_rclpy(turns_bag):
    """What rosbags wrote, ROS reads."""
    serialization = pytest.importorskip('rclpy.serialization')
    sensor_msgs = pytest.importorskip('sensor_msgs.msg')
    with open_bag(turns_bag) as reader:
        for connection, _, raw in reader.messages():
            msg = serialization.deserialize_message(bytes(raw), sensor_msgs.PointCloud2)
            mine = to_columns(reader.deserialize(raw, connection.msgtype), MANY_ROWS)
            for name, column in to_columns(msg, MANY_ROWS).items():
                np.testing.assert_array_equal(column, mine[name])


def test_compressed_bag_holds_the_same(tmp_path, turns_bag):
    """Compression changes the size only."""
    bag = tmp_path / 'small'
    main(['turns', '--output', str(bag), '--duration', '40', '--seed', '5', '--compress'])
    sizes = [(path / 'recording.mcap').stat().st_size for path in (bag, turns_bag)]
    assert sizes[0] < 0.7 * sizes[1]
    for topic, messages in read(turns_bag).items():
        for one, other in zip(messages, read(bag)[topic], strict=True):
            assert (one[0], stamp_of(one[1])) == (other[0], stamp_of(other[1]))
            for name, column in one[2].items():
                np.testing.assert_array_equal(column, other[2][name])


def test_scene_of_a_sonar_has_marks_own_ship_and_truth(tmp_path):
    """A message each cycle on each topic; again the same bytes; another seed, other marks."""
    one, two, other = (tmp_path / name for name in ('one', 'two', 'other'))
    given = ['sonar_watch', '--duration', '60', '--output']
    for bag, more in ((one, ()), (two, ()), (other, ('--seed', '7'))):
        assert main([*given, str(bag), *more]) == 0
    with open_bag(one) as reader:
        found = {c.topic: (c.msgtype, c.msgcount) for c in reader.connections}
    table = 'sensor_msgs/msg/PointCloud2'
    assert found == {
        '/ownship': ('nav_msgs/msg/Odometry', 30), '/bearings': (table, 30), '/truth': (table, 30),
    }  # fmt: skip
    files = [(bag / 'recording.mcap').read_bytes() for bag in (one, two, other)]
    assert files[0] == files[1] != files[2]


def test_unfinished_bag_leaves_nothing(tmp_path):
    """An error while writing takes the half bag away."""
    with pytest.raises(TypesysError, match='no_such'), BagWriter(tmp_path / 'half') as bag:
        bag.announce('plots', 'no_such/msg/Type')
    assert list(tmp_path.iterdir()) == []


def test_bag_topics_are_absolute(tmp_path):
    """Relative names get their slash, once, however they are written."""
    header = TYPESTORE.types['std_msgs/msg/Header']
    stamp = TYPESTORE.types['builtin_interfaces/msg/Time'](sec=1, nanosec=2)
    with BagWriter(tmp_path / 'bag') as bag:
        bag.write('here', header(stamp=stamp, frame_id='a'), 7)
        bag.write('/here', header(stamp=stamp, frame_id='b'), 8)
    with open_bag(tmp_path / 'bag') as reader:
        assert [connection.topic for connection in reader.connections] == ['/here']
        assert [stamp for _, stamp, _ in reader.messages()] == [7, 8]
    assert absolute('/a/b') == absolute('a/b') == '/a/b'


@pytest.mark.parametrize(
    ('arguments', 'complaint'),
    [
        (['tuns', '--output', 'x'], "no scenario 'tuns'; did you mean 'turns'?"),
        (['turns'], 'either --output BAG or --live'),
        (['turns', '--output', '.'], 'exists already'),
        (
            ['turns', '--output', 'x', '--duration', '-3'],
            '--duration: must be a number above 0, got -3',
        ),
        (['z0', '--output', 'x', '--sectors', '2'], 'must be 1 for a staring radar'),
        (
            ['turns', '--output', 'x', '--duration', '1e12'],
            'duration must be at most 447483647 s, when the stamps of messages end, got 1e+12',
        ),
        (['turns', '--output', '/proc/nope/x'], '/proc/nope'),
        (
            ['sonar_watch', '--output', 'x', '--sectors', '2'],
            'sectors must be 1 for a sonar, got 2',
        ),
    ],
)
def test_wrong_command_says_what_is_wrong(arguments, complaint, capsys, tmp_path, monkeypatch):
    """Exit code 2, one clear line, and no bag."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2
    assert complaint in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_scene_that_is_too_large_for_memory_is_told(capsys, tmp_path, monkeypatch):
    """In the words of numpy, which says how large."""
    monkeypatch.setattr('tracking_tools.simulate.record', lambda *_: np.empty(1 << 50))
    with pytest.raises(SystemExit):
        main(['turns', '--output', str(tmp_path / 'x')])
    assert 'Unable to allocate' in capsys.readouterr().err


def test_list_shows_every_scenario(capsys):
    """Name and description of each."""
    assert main(['--list']) == 0
    shown = capsys.readouterr().out
    assert 'crossing  ' in shown
    assert 'two crossing manoeuvring aircraft in clutter' in shown
    assert 'sonar_crossing  ' in shown
