# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""An antenna that wind and motor make faster and slower: the tracks are those of an even one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.config import with_values
from tracking_core.linalg import TURN
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

PERIOD = 4.0
RADAR = SimulatedRadar(
    period=PERIOD, range_sd=20.0, azimuth_sd=0.002, clutter_per_turn=6.0,
    range_limits=(500.0, 40_000.0),
)  # fmt: skip
CONTACTS = tuple(
    Contact(k + 1, Legs((r * np.cos(2.4 * k), r * np.sin(2.4 * k), 0.0), 100.0, 1.3 * k))
    for k, r in enumerate(np.linspace(8e3, 25e3, 8))
)
CONFIG = with_values(
    RadarTrackerConfig(),
    {
        'sensor.range_sd': 20.0,
        'sensor.azimuth_sd': 0.002,
        'sensor.range_max': 40_000.0,
        'motion.horizontal.acceleration_sd': [0.3, 5.0],
        'initiation.speed_max': 300.0,
    },
)


def tracked(degrees: float, swing: float, sectors: int = 1, step: float = 0.0):
    """
    Return a tracker after plots of an antenna that is so far ahead and behind, in such swings.

    Their times are told in steps [s], 0: exactly.
    """
    ahead = np.radians(degrees) * PERIOD / TURN  # [s]

    def warped(time):
        return time + ahead * np.sin(TURN * time / swing)

    values = {'scan.assembly': 'sector'} if sectors > 1 else {}
    tracker = RadarTracker(with_values(CONFIG, values))
    scene = Scenario(RADAR, CONTACTS, 30 * PERIOD)
    for plots, scan in messages(scene, np.random.default_rng(2), sectors):
        time = np.floor(plots.time / step) * step if step else warped(plots.time)
        tracker.track(replace(plots, time=time, stamp=float(warped(scan.start))))
    return tracker


@pytest.mark.parametrize(
    ('degrees', 'swing', 'sectors'), [(5.0, PERIOD, 1), (4.0, PERIOD, 4), (10.0, 60.0, 1)]
)
def test_uneven_antenna_has_the_tracks_of_an_even_one(degrees, swing, sectors) -> None:
    """5 degrees are 9 % in speed once a turn, 10 are 1 % once a minute."""
    even, uneven = (tracked(by, swing, sectors) for by in (0.0, degrees))
    assert_alike(even, uneven)


def assert_alike(one: RadarTracker, other: RadarTracker) -> None:
    """Check that both have the tracks of all contacts, as many plots, and no more of others."""
    for tracker in (one, other):
        assert tracker.tracks.confirmed.sum() == len(tracker.tracks) == len(CONTACTS)
    assert abs(int(other.tracks.hits.sum()) - int(one.tracks.hits.sum())) <= 3
    assert other.state.next_id <= one.state.next_id + 1


@pytest.mark.parametrize(('step', 'sectors'), [(0.125, 1), (0.25, 1), (0.125, 4)])
def test_coarse_times_have_the_tracks_of_exact_ones(step, sectors) -> None:
    """In a quarter of a second the antenna turns by 22 degrees."""
    assert_alike(tracked(0.0, PERIOD, sectors), tracked(0.0, PERIOD, sectors, step))


def test_unevenness_is_what_the_plots_are_off() -> None:
    """Nearly all are within it; that of an even antenna is the noise of the azimuths."""
    even, uneven = (tracked(by, PERIOD, 1).coverage.unevenness for by in (0.0, 5.0))
    assert even == pytest.approx(2.0 * RADAR.azimuth_sd, rel=0.5)
    assert np.radians(5.0) < uneven < np.radians(7.5)
