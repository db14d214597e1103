# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The sonar node as a process: twenty contacts are followed, whatever comes between."""

from geometry_msgs.msg import PointStamped
import numpy as np
import pytest
from std_msgs.msg import UInt32
from std_srvs.srv import Trigger

COLUMNS = {
    'x', 'y', 'z', 'id', 'status', 'coasted', 'time', 'age', 'hits', 'misses',
    'existence_probability', 'manoeuvre_probability', 'p_0', 'gate_threshold', 'gate_volume',
    'nis', 'bearing', 'bearing_rate', 'bearing_sd', 'bearing_rate_sd', 'gate', 'range', 'range_sd',
    'speed', 'course', 'observable', 'covariance',
}  # fmt: skip
PARAMETERS = ('sensor.bearing_sd:=0.004', 'initiation.rate_sd:=0.0005')
DEGREE = np.pi / 180.0
NAN = np.array([np.nan], np.float32)


@pytest.fixture
def sensor(sonar):
    """Test the sonar."""
    return sonar


@pytest.fixture
def node(start_node, probe):
    """Return a sonar node that the probe has met."""
    node = start_node(*PARAMETERS)
    probe.meet()
    return node


def confirmed(table):
    """Return the ids of the confirmed tracks."""
    return set(table['id'][table['status'] == 1].tolist())


def test_twenty_contacts_become_tracks_with_every_column(node, probe):
    """All are confirmed where they are, +-pi included; without an own manoeuvre no range."""
    table = probe.confirmed()
    assert set(table) == COLUMNS
    assert table['covariance'].shape[1] == 16
    assert probe.tables[-1].header.frame_id == 'sonar'
    rows = table['status'] == 1
    np.testing.assert_allclose(
        np.stack([table['x'], table['y']]),
        np.stack([np.cos(table['bearing']), np.sin(table['bearing'])]), atol=1e-6,
    )  # fmt: skip
    found = np.sort(table['bearing'][rows])
    true = np.sort(np.angle(np.exp(1j * probe.sensor.contacts(probe.stamp)['bearing'])))
    np.testing.assert_allclose(found, true, atol=1.0 * DEGREE)
    assert np.all(table['bearing_sd'][rows] < 0.004)
    assert not table['observable'].any()
    assert np.isnan([table['range'], table['range_sd'], table['speed'], table['course']]).all()
    assert np.isnan(table['covariance']).all()
    assert node.log.count("the tracking frame is 'sonar'") == 1


def test_two_contacts_that_cross_keep_their_ids(node, probe):
    """They pass each other in bearing; each goes on under the id it came with."""
    where = {}
    for cycle in range(60):
        probe.stamp += 2.0
        off = 0.1 * (cycle - 30)  # degrees
        bearing = np.array([off, -off, 90.0]) * DEGREE
        table = probe.answer({'bearing': bearing.astype(np.float32)})
        if cycle in (15, 59):
            where[cycle] = dict(zip(table['id'].tolist(), table['bearing'].tolist(), strict=True))
    assert len(where[59]) == 3
    assert where[15].keys() == where[59].keys()
    crossed = [where[15][i] * where[59][i] < 0.0 for i in where[15] if abs(where[15][i]) < 1.0]
    assert crossed == [True, True]


def test_lost_contact_goes_alone_and_is_told_once(node, probe):
    """A contact that falls silent coasts, is deleted, and the others stay."""
    before = confirmed(probe.confirmed())
    deleted = []
    for _ in range(40):
        probe.stamp += 4.0
        columns = {k: v[1:] for k, v in probe.sensor.contacts(probe.stamp).items()}
        table = probe.answer(columns)
        deleted += table['id'][table['status'] == 2].tolist()
        if set(deleted) & before:
            break
    (gone,) = set(deleted) & before
    assert confirmed(probe.scan()) >= before - {gone}
    assert deleted.count(gone) == 1


def test_cycles_that_cannot_be_hurt_no_track(node, probe):
    """NaN, duplicates, old cycles and missing fields are refused or dropped, counted and said."""
    before = confirmed(probe.confirmed())
    last = probe.sensor.contacts(probe.stamp)
    table = probe.scan(extra={'bearing': NAN})
    assert confirmed(table) == before
    for columns, stamp, counted in (
        (last, probe.stamp, 'stamp not newer'),
        (last, probe.stamp - 4.0, 'stamp not newer'),
        ({'bearing': NAN}, probe.stamp + 1.0, 'no usable row'),
        ({'range': NAN}, probe.stamp + 1.0, 'missing field'),
        (last, probe.stamp + 1e6, 'stamp ahead of time'),
    ):
        probe.send(columns, stamp)
        node.wait_for_line('bearings message refused')
        probe.spin_until(
            lambda key=f'bearings refused: {counted}': probe.diagnosed(key), f'count of {counted}'
        )
    assert probe.diagnosed('bearings refused: stamp not newer') == '2'
    assert probe.diagnosed('bearings dropped: bearing is not a number') == '1'
    empty = probe.scan(empty=True)
    assert set(empty['id'].tolist()) >= before
    assert np.all(empty['coasted'] == 1)
    assert confirmed(probe.scan()) == before
    stamps = [(m.header.stamp.sec, m.header.stamp.nanosec) for m in probe.tables]
    assert sorted(set(stamps)) == stamps


def test_acquire_cancel_and_reset(node, probe):
    """A user starts a track at a point, drops it, and forgets all."""
    acquire = probe.node.create_publisher(PointStamped, 'acquire', 10)
    cancel = probe.node.create_publisher(UInt32, 'cancel', 10)
    probe.spin_until(lambda: acquire.get_subscription_count() and cancel.get_subscription_count())
    before = confirmed(probe.confirmed())
    point = PointStamped()
    point.header.frame_id = 'sonar'
    point.point.x = 4e3
    acquire.publish(point)
    node.wait_for_line('started at')
    table = probe.scan()
    (new,) = confirmed(table) - before
    assert abs(table['bearing'][table['id'] == new][0]) < 1.0 * DEGREE
    cancel.publish(UInt32(data=new))
    node.wait_for_line(f'track {new} dropped')
    assert new not in confirmed(probe.scan())
    assert probe.call(Trigger, 'sonar_tracker/reset', Trigger.Request()).success
    table = probe.scan()
    assert set(table['id'][table['status'] == 2].tolist()) >= before
