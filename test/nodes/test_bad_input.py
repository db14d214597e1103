# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Nothing that a message contains hurts a track: it is refused, counted and said."""

from nav_msgs.msg import Odometry
import numpy as np


def ones(rows, **more):
    """Return legal columns of this many rows, with some replaced or added."""
    columns = {'range': np.full(rows, 9e4, np.float32), 'azimuth': np.zeros(rows, np.float32)}
    return {**columns, **more}


def without_azimuth():
    """Return columns that lack one that is needed."""
    return {'range': np.ones(3, np.float32), 'snr': np.ones(3, np.float32)}


# Columns, seconds after the last scan, frame; what the line says, what diagnostics count.
BAD_MESSAGES = [
    (without_azimuth(), 1.0, 'radar', 'azimuth is missing', 'refused: missing field'),
    (ones(100_000), 1.0, 'radar', '100000 x 1, limit 20000', 'refused: too many rows'),
    (
        ones(3, range=np.full(3, np.nan, np.float32)),
        1.0,
        'radar',
        'none of 3 rows',
        'refused: no usable row',
    ),
    (ones(3), 3600.0, 'radar', '3600.0 s ahead of', 'refused: stamp ahead of time'),
    (ones(3), -3600.0, 'radar', '3600.0 s behind', 'refused: stamp behind time'),
    (ones(3), 0.0, 'radar', 'is not after the last one', 'refused: stamp not newer'),
    (ones(3), 1.0, 'masthead', "'masthead', expected 'radar'", 'refused: wrong frame'),
    ({'x': np.ones(2), 'y': np.ones(2)}, 1.0, 'radar', 'do not mix', 'refused: fields changed'),
]
BAD_ROWS = [
    ('range', np.nan, 'range is not a number'),
    ('range', -5.0, 'range is negative'),
    ('range', 1e9, 'range beyond range_max'),
    ('azimuth', np.inf, 'azimuth is not a number'),
    ('azimuth', 270.0, 'azimuth beyond 2 pi'),
]


def test_bad_messages_are_refused_counted_and_said(start_node, probe):
    """Each bad message: a line with field and value, a count, and the same tracks as before."""
    # Best effort, as by default, may lose the message of 800 kB.
    node = start_node('qos_overrides./plots.subscription.reliability:=reliable')
    probe.meet()
    before = probe.confirmed()
    for columns, late, frame, words, counted in BAD_MESSAGES:
        probe.send(columns, probe.stamp + late, frame)
        assert 'plots message refused' in node.wait_for_line(words)
        probe.spin_until(
            lambda key=f'plots {counted}': probe.diagnosed(key) == '1', f'count of {counted}'
        )
        after = probe.scan()
        assert set(after['id'][after['status'] == 1]) >= set(before['id'][before['status'] == 1])
    assert 'starts anew' not in node.log


def test_bad_rows_are_dropped_alone(start_node, probe):
    """A bad row is dropped, counted and said; the rows beside it keep their tracks."""
    node = start_node()
    probe.meet()
    before = probe.confirmed()
    for count, (name, value, reason) in enumerate(BAD_ROWS, 1):
        after = probe.scan(extra=ones(1, **{name: np.array([value], np.float32)}))
        assert '1 of 4 plots dropped' in node.wait_for_line(reason)
        probe.spin_until(lambda n=count: probe.diagnosed('plots rows dropped') == str(n), reason)
        rows = np.isin(after['id'], before['id'][before['status'] == 1])
        assert rows.sum() == 3
        assert np.all(after['coasted'][rows] == 0), reason


def test_scan_without_rows_counts_as_a_look(start_node, probe):
    """A scan that saw nothing is legal, and the tracks miss it."""
    node = start_node()
    probe.meet()
    before = probe.confirmed()
    after = probe.scan(empty=True)
    after = probe.scan(empty=True)
    assert set(after['id']) >= set(before['id'][before['status'] == 1])
    assert after['misses'].max() >= 1
    assert 'refused' not in node.log


def test_recording_that_begins_anew_resets_once(start_node, probe):
    """When time goes back for good, tracking starts anew with one warning."""
    node = start_node()
    probe.meet()
    before = probe.confirmed()
    begin = probe.stamp - 1000.0
    for scan in range(2):
        probe.send(ones(3), begin + 4.0 * scan)
    node.wait_for_line('s behind the last one')
    probe.scan(begin + 8.0)
    table = probe.confirmed()
    assert not set(before['id']) & set(table['id'])
    assert node.log.count('starts anew') == 1


def test_warnings_of_one_kind_come_once_in_five_seconds(start_node, probe):
    """Twenty equal faults make one line, and twenty counts."""
    node = start_node()
    probe.meet()
    for _ in range(20):
        probe.stamp += 0.1
        probe.send(without_azimuth(), probe.stamp)
    probe.spin_until(lambda: probe.diagnosed('plots messages refused') == '20')
    assert node.log.count('field azimuth is missing') <= 2


def test_bad_own_ship_is_refused(start_node, probe):
    """Own ship without an orientation is refused by name, and tracking goes on."""
    node = start_node()
    ownship = probe.tell(Odometry, 'ownship')
    probe.meet()
    probe.peer.wait_until_matched(ownship)
    probe.confirmed()
    msg = Odometry()
    msg.pose.pose.orientation.w = 0.0
    refused = 'ownship message refused'  # best effort: the node may not know the publisher yet
    probe.peer.ask(lambda _: ownship.publish(msg), lambda: refused in node.log, refused)
    assert 'pose.pose.orientation has length 0' in node.wait_for_line(refused)
    probe.scan()


def test_end_of_time_does_not_end_the_node(start_node, probe):
    """Plots after the last stamp that a message can have: tracks of then are told all the same."""
    start_node()
    odometry = []
    end = probe.hear(Odometry, 'radar_tracker/odometry', odometry)
    probe.stamp = 2.0**31 - 46.0
    probe.meet()
    probe.peer.wait_until_matched(end)
    later = {'time': np.array([0.0, 2.0, 9.0], np.float32)}
    for _ in range(11):
        probe.stamp += 4.0
        table = probe.answer(probe.sensor.contacts(1e6 + probe.stamp - 2.0**31) | later)
    assert (table['status'] == 1).sum() == 3
    probe.spin_until(
        lambda: odometry[-1:] and odometry[-1].header.stamp.sec == 2**31 - 1, 'tracks'
    )
