# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the replay: its bytes, its rows, and that it is the live node's equal."""

from pathlib import Path

import numpy as np
import pytest

from msg_adapters.message_types import NANOSECONDS, rosbags_types
from msg_adapters.plots import to_plots
from msg_adapters.table import to_columns
from msg_adapters.tracks import track_columns
from radar_tracker.tracker import RadarTracker
from tracking_tools.bags import BagWriter, open_bag, TYPESTORE
from tracking_tools.demo import play
from tracking_tools.replay import main, RADAR, read_configs, replay
from tracking_tools.replay_topics import Topics

PARAMETERS = Path(__file__).parents[2] / 'config' / 'terminal_radar.yaml'
TRACKS = '/radar_tracker/tracks'
TURNS = 25


def test_replay_gives_the_same_bytes_twice(cut_bag, tmp_path):
    """Whatever the output is called, and whenever it is made."""
    for name in ('one', 'another'):
        arguments = ['--params', str(PARAMETERS), '--output', str(tmp_path / name), '--quiet']
        assert main([str(cut_bag(TURNS)), '--sensor', 'radar', *arguments]) == 0
    one, another = (
        {file.name: file.read_bytes() for file in (tmp_path / name).iterdir()}
        for name in ('one', 'another')
    )
    assert one == another


def test_replay_writes_what_the_tracker_says(cut_bag, tmp_path, messages):
    """Each row is what RadarTracker gives for the same plots, at the time of the plots."""
    config, node_config = read_configs(PARAMETERS, {}, RADAR)
    replay(cut_bag(TURNS), tmp_path / 'out', (config, node_config), quiet=True)
    tracker = RadarTracker(config)
    previous, written = tracker.tracks, messages(tmp_path / 'out', TRACKS)
    recorded = messages(cut_bag(TURNS), '/plots')
    assert len(written) == len(recorded) == TURNS
    for (time, plots), (answered, table) in zip(recorded, written, strict=True):
        tracks = tracker.track(to_plots(plots, config.sensor, config.max_plots).plots)
        stamp = plots.header.stamp.sec + plots.header.stamp.nanosec * 1e-9
        expected = track_columns(previous, tracks, stamp, config.output, config.gate.probability)
        previous, columns = tracks, to_columns(table, 1000)
        assert answered == time
        assert repr(table.header.stamp) == repr(plots.header.stamp)
        assert columns.keys() == expected.keys()
        for name, values in expected.items():
            np.testing.assert_array_equal(columns[name], values, err_msg=name)
    assert previous.confirmed.any()


@pytest.mark.slow
def test_live_node_gives_the_rows_of_the_replay(cut_bag, tmp_path, messages):
    """The node as a process and the replay answer every message with the same rows."""
    live, offline = tmp_path / 'live', tmp_path / 'replay'
    play(cut_bag(TURNS), live, PARAMETERS, 1e6, tmp_path / 'node.log')
    configs = read_configs(PARAMETERS, {}, RADAR)
    replay(cut_bag(TURNS), offline, configs, quiet=True)
    pairs = list(zip(messages(live, TRACKS), messages(offline, TRACKS), strict=True))
    assert len(pairs) == TURNS
    for (live_time, said), (time, expected) in pairs:
        assert live_time == time
        assert repr(said.header) == repr(expected.header)
        assert repr(said.fields) == repr(expected.fields)
        np.testing.assert_array_equal(said.data, expected.data)
    assert pairs[-1][1][1].width > 0


def test_replay_reads_sqlite3_bags(cut_bag, tmp_path, messages):
    """The storage of older recordings gives the same rows."""
    from rosbags.rosbag2 import StoragePlugin, Writer  # noqa: PLC0415

    writer = Writer(tmp_path / 'db3', version=8, storage_plugin=StoragePlugin.SQLITE3)
    with open_bag(cut_bag(TURNS)) as bag, writer:
        topics = {
            c.topic: writer.add_connection(c.topic, c.msgtype, typestore=TYPESTORE)
            for c in bag.connections
        }
        for connection, time, raw in bag.messages():
            writer.write(topics[connection.topic], time, raw)
    replay(tmp_path / 'db3', tmp_path / 'one', quiet=True)
    replay(cut_bag(TURNS), tmp_path / 'other', quiet=True)
    one, other = (tmp_path / name / 'recording.mcap' for name in ('one', 'other'))
    assert one.read_bytes() == other.read_bytes()


def test_replay_follows_own_ship(tmp_path, messages, plots_message):
    """Plots from a sensor on a moving ship become tracks in the frame of its odometry."""
    types = rosbags_types()
    path = tmp_path / 'ship'
    with BagWriter(path) as bag:
        for k in range(8):
            time = 1000.0 + 2.0 * k
            odometry = _odometry(types, time, x=10.0 * time - 10_000.0, speed=10.0)
            bag.write('odom', odometry, int(time * NANOSECONDS))
            # A buoy 2 km ahead of where the ship was at the start.
            plots = plots_message(time, range=[2000.0 - 20.0 * k], azimuth=[0.0])
            bag.write('plots', plots, int(time * NANOSECONDS) + 1000)
    topics = Topics.remapped(['ownship:=/odom'])
    replay(path, tmp_path / 'out', topics=topics, quiet=True)
    _, table = messages(tmp_path / 'out', TRACKS)[-1]
    columns = to_columns(table, 10)
    assert table.header.frame_id == 'odom'
    np.testing.assert_allclose(columns['x'], 2000.0, atol=1.0)
    np.testing.assert_allclose(columns['vx'], 0.0, atol=0.5)


def _odometry(types, time, x, speed):
    zero = types.Vector3(x=0.0, y=0.0, z=0.0)
    pose = types.Pose(
        position=types.Point(x=x, y=0.0, z=0.0),
        orientation=types.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
    )
    twist = types.Twist(linear=types.Vector3(x=speed, y=0.0, z=0.0), angular=zero)
    return types.Odometry(
        header=types.header(time, 'odom'),
        child_frame_id='ship',
        pose=types.PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
        twist=types.TwistWithCovariance(twist=twist, covariance=np.zeros(36)),
    )


def test_replay_follows_orders(cut_bag, tmp_path, messages):
    """A contact is pointed at in the tenth turn, and the first track is dropped in the twelfth."""
    kinds = TYPESTORE.types
    point = kinds['geometry_msgs/msg/PointStamped']
    place = kinds['geometry_msgs/msg/Point'](x=20e3, y=20e3, z=0.0)
    with BagWriter(tmp_path / 'ordered') as bag:
        for turn, (time, plots) in enumerate(messages(cut_bag(TURNS), '/plots')):
            bag.write('/plots', plots, time)
            if turn == 10:
                bag.write('/acquire', point(header=plots.header, point=place), time + 1)
            if turn == 12:
                bag.write('/cancel', kinds['std_msgs/msg/UInt32'](data=1), time + 1)
    summary = replay(tmp_path / 'ordered', tmp_path / 'out', quiet=True)
    assert summary.tables == TURNS
    tables = [to_columns(msg, 1000) for _, msg in messages(tmp_path / 'out', TRACKS)]
    started = np.setdiff1d(tables[11]['id'], tables[10]['id'])
    assert np.hypot(*(tables[11][axis] - 20e3 for axis in 'xy'))[
        np.isin(tables[11]['id'], started)
    ].min() < 2e3  # fmt: skip
    assert 1 in tables[12]['id']
    assert 1 not in tables[14]['id']
