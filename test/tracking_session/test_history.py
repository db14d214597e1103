# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which late messages have a place, and how many messages are kept."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from tracking_core.platform import Platform, StalePlatform
from tracking_session.history import FEWEST, History, MOST


@dataclass
class Known:
    """What a tracker remembers, as far as a history asks."""

    next_id: int
    tracks: range


def instrument(turn=0.0, tracks=10):
    """Return a sensor that turns in so many seconds and has so many tracks, always the same."""
    tracker = SimpleNamespace(
        save=lambda: None,
        restore=lambda memory: None,
        turn_time=turn,
        state=Known(1, range(tracks)),
    )
    return SimpleNamespace(tracker=tracker, track=lambda plots, platform, frame: None)


@dataclass
class Rows:
    """Plots, as far as a history asks."""

    stamp: float
    count: int

    def __len__(self) -> int:
        return self.count


def at(stamp, plots=20):
    """Return plots of this stamp."""
    return Rows(stamp, plots)


def filled(stamps, scans=3, turn=0.0, margin=10.0, tracks=10, plots=20):
    """Return a history of messages with these stamps."""
    history = History(instrument(turn, tracks), scans, margin)
    for stamp in stamps:
        history.step(at(stamp, plots), None, None)
    return history


def test_late_messages_have_a_place_for_three_scans():
    """Between the scans that are kept, not before them, not twice."""
    history = filled([0.0, 4.0, 8.0, 12.0, 16.0])
    assert [history.takes(t) for t in (4.0, 5.0, 8.0, 9.0, 15.0, 16.0, 17.0)] == [
        False, True, False, True, True, False, False,
    ]  # fmt: skip
    assert [history.has_lost(t) for t in (3.9, 4.0, 5.0)] == [True, False, False]


def test_first_messages_may_be_preceded_by_the_margin_only():
    """Nothing is known to be missing before the first message."""
    history = filled([100.0])
    assert history.takes(95.0)
    assert not history.takes(89.0)
    assert not filled([]).takes(0.0)


def test_sectors_are_kept_for_three_turns():
    """Eight sectors a turn: three turns are 24 messages."""
    history = filled([0.5 * k for k in range(100)], turn=4.0)
    assert history.takes(49.5 - 12.0 + 0.1)
    assert not history.takes(49.5 - 12.0 - 0.6)


def test_sectors_of_turns_that_nobody_knows_yet_are_kept_for_the_margin():
    """It may be the late ones that tell how the antenna turns."""
    for scans in (3, 0):
        history = filled([0.5 * k for k in range(100)], scans, turn=np.inf)
        assert [history.takes(49.5 - late) for late in (9.8, 10.6)] == [scans > 0, False]


@pytest.mark.parametrize('turn', [4.0 - 1e-6, 4.0, 4.0 + 1e-6])
def test_turns_are_late_by_whole_ones(turn):
    """Three may be, four not, whatever the time of a turn is rounded to."""
    messages = [4.0 * k for k in range(10)]
    for missing, late in ((20.0, False), (24.0, True)):
        history = filled([t for t in messages if t != missing], turn=turn)
        assert history.takes(missing) is late
        assert history.has_lost(missing) is not late


@pytest.mark.parametrize(('sectors', 'tracks'), [(128, 300), (64, 900), (20, 100_000)])
def test_narrow_sectors_have_a_place_for_three_turns(sectors, tracks):
    """As far as the number of tracks allows."""
    history = filled([4.0 * k / sectors for k in range(5 * sectors)], turn=4.0, tracks=tracks)
    assert history.takes(20.0 - 12.0 + 0.01)
    assert not history.lacks_room(1.0)


@pytest.mark.parametrize(
    ('tracks', 'plots', 'most'),
    [
        (10, 20, MOST),
        (1000, 4, 199),
        (100_000, 20, FEWEST),
        (10, 5_000, 197),
        (10, 20_000, FEWEST),
    ],
)
def test_memory_is_bounded(tracks, plots, most):
    """However small the sectors are, and the fewer the more rows; who comes later is told so."""
    history = filled([1e-3 * k for k in range(1000)], turn=4.0, tracks=tracks, plots=plots)
    assert history.span == pytest.approx(1e-3 * most)
    assert history.lacks_room(0.9995 - 1e-3 * most - 0.001)
    assert not history.lacks_room(0.9995)
    assert not history.lacks_room(-12.0)
    assert len(history) == most


def test_steps_keep_as_much_of_the_path_as_a_turn_needs():
    """Not a minute of own ship's odometry for each of hundreds of sectors."""
    time = np.arange(0.0, 60.0, 0.01)
    zero, covariance = np.zeros((len(time), 3)), np.zeros((len(time), 3, 3))
    turn = np.tile([0.0, 0.0, 0.0, 1.0], (len(time), 1))
    path = Platform(time, zero, turn, zero, covariance, 0.0 * time)
    sensor, seen = instrument(turn=4.0), []
    history = History(sensor, 3, 10.0)
    history.step(at(59.0), path, None)

    def refuse(plots, platform, frame):
        seen.append(platform)
        if plots.stamp == 59.0:
            raise StalePlatform('seen enough')

    sensor.track = refuse
    with pytest.raises(StalePlatform):
        history.insert(at(58.0), path, None)
    kept = seen[-1]
    assert kept.time[0] == pytest.approx(51.0, abs=0.02)
    assert kept.time[-1] == time[-1]
    assert all(values.base is None for values in vars(kept).values() if np.ndim(values))


@pytest.mark.parametrize('scans', [0, 1, 5])
def test_as_many_scans_are_kept_as_the_parameter_says(scans):
    """None at all with 0."""
    history = filled([4.0 * k for k in range(20)], scans)
    assert history.takes(4.0 * (19 - scans) + 1.0) == (scans > 0)
    assert not history.takes(4.0 * (18 - scans) + 1.0)
    assert len(history) == scans
    assert not filled([0.0, 4.0], 0, turn=4.0).takes(2.0)


def test_nothing_comes_before_what_was_closed():
    """A user's command is not undone."""
    history = filled([0.0, 4.0])
    history.close()
    history.step(at(8.0), None, None)
    assert history.takes(6.0)
    assert not history.takes(3.0)
