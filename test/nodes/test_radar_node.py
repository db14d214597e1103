# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The radar node as a process: tracks come out, whatever goes in."""

from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from std_msgs.msg import UInt32
from std_srvs.srv import Trigger
from visualization_msgs.msg import MarkerArray

from tracking_tools.screen import Screen

COLUMNS = {
    'x', 'y', 'z', 'vx', 'vy', 'vz', 'id', 'status', 'coasted', 'time', 'age', 'hits', 'misses',
    'existence_probability', 'manoeuvre_probability', 'p_0', 'p_1', 'gate_threshold',
    'gate_volume', 'nis', 'speed', 'course', 'covariance', 'gate_x', 'gate_y', 'gate_z',
}  # fmt: skip


def test_tracks_appear_with_every_column(start_node, probe):
    """Three contacts become three confirmed tracks, in the frame of the plots."""
    node = start_node()
    probe.meet()
    table = probe.confirmed()
    assert set(table) >= COLUMNS
    assert table['covariance'].shape[1] == 36
    assert probe.tables[-1].header.frame_id == 'radar'
    assert np.allclose(sorted(table['speed']), sorted([170.0, 156.2, 150.0]), atol=40.0)
    assert node.log.count("the tracking frame is 'radar'") == 1


def test_views_come_while_somebody_subscribes(start_node, probe):
    """Odometry of confirmed tracks and markers reach a viewer."""
    start_node('markers.rate:=100.0')
    odometry, markers = [], []
    ends = [
        probe.hear(Odometry, 'radar_tracker/odometry', odometry),
        probe.hear(MarkerArray, 'radar_tracker/markers', markers),
    ]
    probe.meet()
    probe.spin_until(lambda: all(end.get_publisher_count() for end in ends))
    table = probe.confirmed()
    parts = {'history', 'velocity', 'covariance', 'gate', 'id'}
    probe.spin_until(lambda: markers and parts == {marker.ns for marker in markers[-1].markers})
    probe.spin_until(lambda: len(odometry) >= 3)
    names = {f'track_{track_id}' for track_id in table['id'][table['status'] == 1]}
    assert {msg.child_frame_id for msg in odometry[-3:]} == names


@pytest.mark.parametrize('end', ['reset', 'deactivate', 'active_shutdown'])
def test_screen_shows_no_tracks_of_another_run_and_none_after_a_reset(start_node, probe, end):
    """A viewer outlives a node that was killed; nobody waits for plots to see an end."""
    screen, markers = Screen(), []
    screen.markers['gate', 77] = None  # drawn by the node that was killed
    start_node('markers.rate:=100.0')
    viewer = probe.hear(MarkerArray, 'radar_tracker/markers', markers)
    probe.meet()
    probe.peer.wait_until_matched(viewer)
    ids = set(probe.confirmed()['id'].tolist())
    probe.spin_until(lambda: screen.take_all(markers) and screen.ids() == ids, 'the tracks alone')
    if end == 'reset':
        probe.reset()
    else:
        assert probe.peer.change_state('radar_tracker', end)
    probe.spin_until(lambda: screen.take_all(markers) and not screen.ids(), 'a clear screen')


def test_reset_forgets_all_tracks_and_says_so(start_node, probe):
    """After ~/reset the old tracks are reported as deleted once, and new ids begin."""
    start_node()
    probe.meet()
    before = set(probe.confirmed()['id'])
    assert probe.call(Trigger, 'radar_tracker/reset', Trigger.Request()).success
    first, second = probe.scan(), probe.scan()
    assert set(first['id'][first['status'] == 2]) == before
    assert not before & set(second['id'])


def test_cancel_drops_one_track(start_node, probe):
    """The cancelled track is deleted, the others stay."""
    node = start_node()
    cancel = probe.node.create_publisher(UInt32, 'cancel', 10)
    probe.meet()
    probe.spin_until(cancel.get_subscription_count)
    before = probe.confirmed()
    cancel.publish(UInt32(data=int(before['id'][0])))
    node.wait_for_line(f'track {before["id"][0]} dropped')
    after = probe.scan()
    deleted = after['status'] == 2
    assert list(after['id'][deleted]) == [before['id'][0]]
    assert set(after['id'][~deleted]) >= set(before['id'][1:])


def test_acquire_starts_a_track_at_the_point(start_node, probe):
    """A point in the tracking frame becomes a confirmed track."""
    node = start_node()
    acquire = probe.node.create_publisher(PointStamped, 'acquire', 10)
    probe.meet()
    probe.spin_until(acquire.get_subscription_count)
    before = probe.confirmed()
    point = PointStamped()
    point.header.frame_id = 'radar'
    point.point.x, point.point.y = 40e3, 40e3
    acquire.publish(point)
    node.wait_for_line('started at')
    probe.spin_until(lambda: probe.diagnosed('acquire messages') == '1', 'its count')
    after = probe.scan()
    new = ~np.isin(after['id'], before['id'])
    assert np.hypot(after['x'][new] - 40e3, after['y'][new] - 40e3).min() < 1e3
