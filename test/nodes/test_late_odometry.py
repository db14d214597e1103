# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The live radar node on a ship whose odometry comes later than the plots of its time."""

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rcl_interfaces.srv import GetParameters
from rosgraph_msgs.msg import Clock

from msg_adapters.message_types import rclpy_types
from msg_adapters.table import to_columns
from tracking_session.snapshots.file import read_snapshot

RELIABLE = [
    f'qos_overrides./{topic}.subscription.reliability:=reliable' for topic in ('ownship', 'plots')
]
STEP, LATE = 2.0, 0.5  # s between scans; the newest odometry is so much older than a scan
BUOY = np.array([5000.0, 1000.0])  # [m]


def heading(time):
    """Return that of a ship which yaws by 0.1 rad to either side [rad]."""
    return 0.1 * np.sin(2.0 * time)


class Ship:
    """A ship that lies and yaws, with a radar; time counts from the first odometry."""

    def __init__(self, probe):
        self.probe, self._ownship = probe, probe.tell(Odometry, 'ownship')
        probe.meet()
        probe.peer.wait_until_matched(self._ownship)
        probe.reset()
        self._epoch = probe.stamp
        self.now, self.looks, self.told = 0.0, 0, 0

    def tell(self, *times):
        """Publish odometry of these times."""
        for time in times:
            stamp, half = self._epoch + time, 0.5 * heading(time)
            msg = Odometry(header=rclpy_types().header(stamp, 'odom'), child_frame_id='base_link')
            msg.pose.pose.orientation.z = float(np.sin(half))
            msg.pose.pose.orientation.w = float(np.cos(half))
            self._ownship.publish(msg)

    def look(self):
        """Publish the next scan, and odometry up to `LATE` before it."""
        times = self.now + STEP - LATE + np.arange(-STEP + 0.1, 0.05, 0.1)
        self.tell(*times)
        self.looks, self.told = self.looks + 1, self.told + len(times)
        self.now += STEP
        self.probe.stamp = self._epoch + self.now
        azimuth = np.arctan2(BUOY[1], BUOY[0]) - heading(self.now)
        columns = {'range': [np.hypot(*BUOY)], 'azimuth': [azimuth]}
        self.probe.send({k: np.array(v) for k, v in columns.items()}, self.probe.stamp)
        self.until_heard()

    def until_heard(self):
        """Wait until the node, which has one thread, has taken all that it was sent."""
        request = GetParameters.Request(names=['ownship_patience'])
        self.probe.call(GetParameters, 'radar_tracker/get_parameters', request)

    def taken(self):
        """Return how many scans and odometries the node has taken, by its next diagnostics."""
        heard = len(self.probe.diagnostics)
        self.probe.spin_until(lambda: len(self.probe.diagnostics) > heard, 'diagnostics')
        return np.array([int(self.probe.diagnosed(f'{t} messages')) for t in ('plots', 'ownship')])

    def until_taken(self, looks, before):
        """Wait until the node has so many looks more than `before`: topics overtake calls."""
        wanted = before + looks * np.array([1, self.told // self.looks])
        assert any((self.taken() >= wanted).all() for _ in range(20)), wanted

    @property
    def is_answered(self):
        """Whether the last scan is."""
        return self.probe.is_answered(self.probe.stamp)

    def until_answered(self):
        """Wait for the tracks of the last scan."""
        self.probe.spin_until(lambda: self.is_answered, 'tracks')

    def until_told(self, key, value):
        """Wait for a value in the diagnostics."""
        self.probe.spin_until(lambda: self.probe.diagnosed(key) == value, key)


@pytest.fixture
def sail(start_node, probe):
    """Return a function that starts a node on such a ship."""

    def start(*parameters):
        node = start_node(*RELIABLE, 'sensor.azimuth_sd:=0.001', *parameters)
        ship = Ship(probe)
        ship.tell(-0.2, -0.1, 0.0)  # one alone is not believed
        node.wait_for_line("the tracking frame is 'odom'")
        return node, ship

    return start


def test_plots_wait_for_the_odometry_of_their_time(sail, probe):
    """The buoy lies still; placed by how the ship turned before, it would be 250 m off."""
    node, ship = sail('ownship_patience:=20.0')
    for _ in range(12):
        ship.look()
        assert not ship.is_answered
        ship.tell(ship.now - 0.2)  # this one does not do
        ship.until_heard()
        assert not ship.is_answered
        ship.tell(ship.now)
        ship.until_answered()
    table = to_columns(probe.tables[-1], 100)
    (row,) = np.flatnonzero(table['status'] == 1)
    assert np.hypot(table['x'][row] - BUOY[0], table['y'][row] - BUOY[1]) < 10.0
    assert table['speed'][row] < 2.0
    waited = 'plots waited [s]'
    probe.spin_until(lambda: float(probe.diagnosed(waited) or 0.0) > 0.0, waited)
    assert float(probe.diagnosed(waited)) < 20.0
    assert probe.diagnosed('plots waited in vain') == '0'
    assert 'in vain' not in node.log


def test_plots_do_not_wait_for_ever_which_is_told(sail, probe):
    """They are used as without waiting, counted, and the reason is in the diagnostics."""
    node, ship = sail('ownship_patience:=0.6')
    ship.look()
    ship.until_answered()
    ship.until_told('plots waited in vain', '1')
    said = 'plots waited in vain for ownship'
    assert any(said in msg.status[0].message for msg in probe.diagnostics)
    assert 0.1 < float(probe.diagnosed('plots waited [s]')) < 0.7
    line = node.wait_for_line('in vain')
    assert 'for odometry of their time (ownship_patience)' in line


def test_plots_that_wait_are_used_where_the_node_is_deactivated(sail, probe):
    """In order, and their tracks are published."""
    _, ship = sail('ownship_patience:=60.0')
    heard, before = len(probe.tables), ship.taken()
    for _ in range(3):
        ship.look()
    ship.until_taken(3, before)
    assert len(probe.tables) == heard + 2  # of which odometry came before the next
    request = ChangeState.Request(transition=Transition(id=Transition.TRANSITION_DEACTIVATE))
    assert probe.call(ChangeState, 'radar_tracker/change_state', request).success
    ship.until_answered()
    assert len(probe.tables) == heard + 3


def test_node_that_ends_while_plots_wait_keeps_what_they_tell(sail, probe, tmp_path):
    """Nobody can hear of their tracks any more, but they are in the snapshot."""
    file = tmp_path / 'tracks'
    node, ship = sail('ownship_patience:=60.0', f'snapshot.file:={file}')
    before = ship.taken()
    ship.look()
    ship.until_taken(1, before)
    assert not ship.is_answered
    assert node.stop() == 0
    assert 'Traceback' not in node.log
    sec, nanosec = read_snapshot(file)['session']['stamp']
    assert sec + 1e-9 * nanosec == pytest.approx(probe.stamp, abs=1e-6)


def test_plots_do_not_wait_for_ever_where_simulated_time_stands_still(start_node, probe):
    """As at the end of a recording that is played."""
    start_node(*RELIABLE, 'use_sim_time:=true', 'ownship_patience:=8.0')
    clock = probe.tell(Clock, '/clock')
    probe.peer.wait_until_matched(clock)
    ship = Ship(probe)
    clock.publish(Clock(clock=rclpy_types().header(probe.stamp, '').stamp))
    probe.until_diagnosed_at(probe.stamp)
    ship.tell(-0.2, -0.1, 0.0)
    ship.look()
    assert not ship.is_answered
    ship.until_answered()
