# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of a radar, or marks of a sonar, on a ship that yaws and whose odometry comes late."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.message_types import stamp_of
from msg_adapters.ownship import to_platform
from msg_adapters.table import from_columns, to_columns
from tracking_core.config import with_values
from tracking_session.waiting import MOST, ROOM, Waiting
from tracking_session.whereabouts import NotYet
from tracking_tools.sensors import SENSORS

TYPES = pytest.importorskip('msg_adapters.message_types').rosbags_types()
EPOCH, STEP, SCANS = 1000.0, 2.0, 15  # [s]
BUOY = np.array([5000.0, 1000.0])  # [m]
VALUES = {'radar': {'sensor.azimuth_sd': 0.001}, 'sonar': {'sensor.bearing_sd': 0.001}}


def heading(time):
    """Return that of a ship which yaws by 0.1 rad to either side [rad]."""
    return 0.1 * np.sin(time)


def odometry(time):
    """Return own ship's."""
    half, none = 0.5 * float(heading(time)), TYPES.Vector3(x=0.0, y=0.0, z=0.0)
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=np.sin(half), w=np.cos(half))
    pose = TYPES.Pose(position=TYPES.Point(x=0.0, y=0.0, z=0.0), orientation=turn)
    return TYPES.Odometry(
        header=TYPES.header(EPOCH + time, 'odom'), child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
        twist=TYPES.TwistWithCovariance(
            twist=TYPES.Twist(linear=none, angular=none), covariance=np.zeros(36)
        ),
    )  # fmt: skip


class Deck:
    """A session, what is told to it, and when each of its tables came."""

    def __init__(self, kind='radar', **node_values):
        config, node_config = SENSORS[kind].configs
        node_config = replace(node_config, **node_values)
        self._names = ('azimuth', 'range') if kind == 'radar' else ('bearing',)
        self.lines = []
        log = logging.getLogger(f'waiting {id(self)}')
        log.warning = self.lines.append
        tracker = with_values(config, VALUES[kind])
        self.session = SENSORS[kind].make_session(tracker, node_config, TYPES, log)
        self.waiting = Waiting(self.session, node_config, self._use)
        self.tables, self.came, self.now = [], [], 0.0  # [s]

    @property
    def count(self):
        """Of the plots."""
        return self.session.counts[self.session.instrument.topic]

    def _use(self, came, patience):
        table = self.session.plots(came.msg, came.received, patience)
        if table is not None:
            self.tables.append(table)
            self.came.append(self.now)

    def look(self, time, now=None):
        """See the buoy."""
        self.now = time if now is None else now
        values = (np.arctan2(BUOY[1], BUOY[0]) - heading(time), np.hypot(*BUOY))
        columns = {name: np.array([v]) for name, v in zip(self._names, values, strict=False)}
        msg = from_columns(columns, EPOCH + time, 'sensor', TYPES)
        self.waiting.plots(msg, self.now)

    def tell(self, time, now=None):
        """Hear of the ship."""
        self.now = time if now is None else now
        self.waiting.ownship(odometry(time), self.now)

    def wait(self, now):
        """Let time go on."""
        self.now = now
        self.waiting.retry(now)

    def sail(self, rate, late):
        """Hear of the ship so often [Hz] and so late [s] while the radar looks."""
        told = [(time + late, self.tell, time) for time in np.arange(-1.0, 40.0, 1.0 / rate)]
        seen = [(STEP * n + 0.03, self.look, STEP * n) for n in range(1, SCANS)]
        for now, act, time in sorted([*told, *seen], key=lambda event: event[0]):
            self.wait(now)
            act(time, now)

    @property
    def stamps(self):
        """Of the tables [s]."""
        return [stamp_of(table) - EPOCH for table in self.tables]

    @property
    def waits(self):
        """From when each scan came to its table [s]."""
        return np.array(self.came) - np.array(self.stamps) - 0.03


def directions(deck):
    """Return where the track of the buoy is seen in the last five tables (5,) [rad]."""
    found = []
    for table in deck.tables[-5:]:
        columns = to_columns(table, 10)
        (row,) = np.flatnonzero(columns['status'] == 1)
        found.append(np.arctan2(columns['y'][row], columns['x'][row]))
    return np.array(found)


@pytest.mark.parametrize('kind', SENSORS)
@pytest.mark.parametrize('rate_and_delay', [(10.0, 0.5), (2.0, 0.3), (1.0, 1.0)])
def test_buoy_lies_still_however_late_the_odometry_is(kind, rate_and_delay):
    """As by odometry in time, but for what the ship turns unevenly from sample to sample."""
    rate, late = rate_and_delay
    deck = Deck(kind)
    deck.sail(rate, late)
    between = 0.1 / rate**2 / 8.0  # by which a line is off a sine, at most
    assert deck.stamps == [STEP * n for n in range(1, SCANS)]
    off = np.abs(directions(deck) - np.arctan2(BUOY[1], BUOY[0]))
    assert off.max() < 0.003 + 1.5 * between
    assert 0.0 < deck.waits.max() <= 1.0 / rate + late + 1e-6
    assert deck.count.in_vain == 0


def test_odometry_in_time_is_never_waited_for():
    """At 20 Hz the newest is near enough, whenever plots come."""
    deck = Deck()
    deck.sail(20.0, 0.0)
    np.testing.assert_allclose(deck.waits, 0.0, atol=1e-6)


def test_land_radar_waits_for_nobody():
    """It has no own ship."""
    deck = Deck()
    for number in range(SCANS):
        deck.look(STEP * number)
    assert deck.came == [STEP * number for number in range(SCANS)]


def test_plots_wait_no_longer_than_they_may_which_is_told():
    """Then they are placed as without waiting; counted, and said with the parameter's name."""
    deck = Deck(ownship_patience=0.6)
    deck.tell(0.0)
    deck.look(0.5)
    deck.wait(1.05)
    assert not deck.tables
    assert not deck.lines
    deck.wait(1.15)
    assert deck.stamps == [0.5]
    assert deck.count.in_vain == 1
    assert deck.count.wait == pytest.approx(0.65)
    (line,) = deck.lines
    assert 'plots have waited 0.65 s in vain for odometry of their time (ownship_patience)' in line


def test_own_ship_that_has_stopped_is_not_waited_for():
    """It tells ten times a second, so soon it is known; what comes later does not wait at all."""
    deck = Deck(ownship_timeout=60.0)
    for time in np.arange(-1.0, 0.05, 0.1):
        deck.tell(time)
    times = np.arange(0.1, 10.0, 0.1)
    for time in times:
        deck.wait(time)
        deck.look(time)
    waits = np.array(deck.came) - deck.stamps
    np.testing.assert_allclose(deck.stamps, times, atol=1e-6)
    assert 0.4 < waits.max() < 0.8
    assert (waits[times > 0.85] < 1e-6).all()
    assert deck.count.in_vain == pytest.approx(6, abs=1)


def test_odometry_that_comes_more_seldom_than_plots_may_wait_is_not_waited_for():
    """It could hardly come by then."""
    deck = Deck(ownship_timeout=60.0)
    deck.sail(0.2, 0.0)
    np.testing.assert_allclose(deck.waits, 0.0, atol=1e-6)
    assert len(deck.tables) == SCANS - 1


def test_a_stamp_that_is_far_ahead_holds_up_nobody():
    """Its odometry cannot come while it may wait; it is refused, as it was."""
    deck = Deck()
    deck.tell(-0.1)
    deck.tell(0.0)
    deck.look(0.0)
    deck.look(3600.0, 1.0)
    deck.look(0.05, 1.1)
    assert deck.stamps == pytest.approx([0.0, 0.05])
    assert deck.count.refused == {'own ship stale': 1}


def test_order_is_kept_and_no_more_wait_than_there_is_room_for():
    """The oldest are used before their time, and none is lost."""
    deck = Deck(ownship_patience=60.0)
    deck.tell(-0.1)
    deck.tell(0.0)
    times = 0.2 + 0.005 * np.arange(MOST + 50)
    for time in times:
        deck.look(time)
    assert len(deck.waiting) == MOST
    assert deck.count.in_vain == 50
    deck.tell(2.0)
    np.testing.assert_allclose(deck.stamps, times, atol=1e-6)


def test_large_messages_that_wait_take_little_room():
    """Whatever is in them: the oldest are used, or refused, before their time."""
    deck = Deck(ownship_patience=60.0)
    deck.tell(0.0)
    deck.look(0.5)
    huge = replace(from_columns({'nothing': np.zeros(ROOM // 32)}, 1000.6, 'sensor', TYPES))
    for _ in range(6):
        deck.waiting.plots(huge, 0.6)
    assert deck.stamps == [0.5]
    assert not deck.waiting
    assert deck.count.refused.total() == 6


def test_plots_that_wait_are_used_before_time_goes_back():
    """A recording that begins anew takes the path along that they were waiting for."""
    deck = Deck(ownship_patience=60.0)
    for time in (29.8, 29.9, 30.0):
        deck.tell(time)
    deck.look(30.5)
    assert not deck.tables
    deck.tell(0.0, 31.0)
    assert deck.stamps == [30.5]


def test_nothing_waits_when_all_is_over_or_forgotten():
    """Released plots are used, forgotten ones are not."""
    for end, expected in (('release', [0.5]), ('clear', [])):
        deck = Deck()
        deck.tell(0.0)
        deck.look(0.5)
        getattr(deck.waiting, end)()
        assert not deck.waiting
        assert deck.stamps == expected
        deck.wait(9.0)
        assert deck.stamps == expected


def test_transforms_are_waited_for_in_the_same_queue():
    """In order; what has waited for too long is refused, with what is missing."""

    class Transforms:
        known = False

        def sensor(self, frame, into, times):
            if not self.known:
                raise NotYet(f'no transform from {frame} to {into}')
            return to_platform(odometry(float(times[0]) - EPOCH))

    deck, transforms = Deck(use_tf=True, tracking_frame='map'), Transforms()
    deck.session.use_transforms(transforms)
    deck.look(0.0)
    deck.wait(0.6)
    assert deck.count.refused == {'no transform': 1}
    assert 'no transform from sensor to map' in deck.lines[-1]
    assert deck.count.in_vain == 0
    for time in (1.0, 1.2):
        deck.look(time)
    transforms.known = True
    deck.wait(1.3)
    assert deck.stamps == pytest.approx([1.0, 1.2])
