# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is learnt of clutter is what neither known nor new contacts explain, once."""

from __future__ import annotations

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.clutter_map import cells, RINGS, SPOKES
from tracking_core.config import with_values
from tracking_core.space import POINTS
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

RADAR = SimulatedRadar(
    period=4.0, range_sd=20.0, azimuth_sd=0.003, detection_probability=1.0,
    range_limits=(500.0, 40_000.0),
)  # fmt: skip
SITE = {
    'sensor.range_sd': 20.0, 'sensor.azimuth_sd': 0.003, 'sensor.range_max': 40e3,
    'motion.horizontal.acceleration_sd': [0.3, 5.0], 'initiation.speed_max': 100.0,
    'scan.period': 4.0,
}  # fmt: skip


def contacts(count, speed):
    """Return contacts in all directions, each on its own course."""
    rng = np.random.default_rng(2)
    angle, distance = rng.uniform(-np.pi, np.pi, count), rng.uniform(5e3, 35e3, count)
    return tuple(
        Contact(k + 1, Legs((r * np.cos(a), r * np.sin(a), 0.0), speed, rng.uniform(-3.0, 3.0)))
        for k, (a, r) in enumerate(zip(angle, distance, strict=True))
    )


def followed(there, turns, clutter, sectors=1, **values):
    """Return the tracker after some turns."""
    radar = SimulatedRadar(**{**vars(RADAR), 'clutter_per_turn': clutter})
    assembly = 'sector' if sectors > 1 else 'message'
    tracker = RadarTracker(
        with_values(RadarTrackerConfig(), {**SITE, 'scan.assembly': assembly, **values})
    )
    scene = Scenario(radar, there, turns * radar.period)
    for plots, _ in messages(scene, np.random.default_rng(7), sectors):
        tracker.track(plots)
    return tracker


def test_clutter_beside_a_contact_stays_in_the_map() -> None:
    """Plots of a contact are taken back once, not look by look for as long as it is followed."""
    tracker = followed(contacts(3, 0.0), 40, 600.0)
    tracks, count = tracker.tracks, tracker.state.clutter.map.count
    places = tracks.planes[0].mean[tracks.confirmed][:, 0, [0, 2]]
    beside = np.arange(-1, 2)
    for spoke, ring in zip(*np.divmod(cells(POINTS, (0.0, 0.0, 0.0), places), RINGS), strict=True):
        here, elsewhere = (
            count[np.ix_((spoke + turn + beside) % SPOKES, ring + beside)].sum()
            for turn in (0, SPOKES // 3)
        )
        assert here > 0.5 * elsewhere > 0.0


def test_clutter_is_the_same_in_sectors() -> None:
    """Plots that wait for the next sector are counted then, and by then they are a contact's."""
    found = [followed(contacts(60, 60.0), 15, 20.0, sectors) for sectors in (1, 12)]
    whole, parts = (tracker.state.clutter.density for tracker in found)
    assert parts == pytest.approx(whole, rel=0.25)


def test_new_contacts_are_no_clutter() -> None:
    """Without false plots nothing is left to count once all contacts are confirmed."""
    tracker = followed(contacts(60, 60.0), 4, 0.0)
    assert tracker.tracks.confirmed.all()
    assert tracker.state.clutter.map.count.sum() < 0.1


def test_nothing_is_learnt_where_the_density_is_told() -> None:
    """The user knows it."""
    tracker = followed(contacts(3, 0.0), 4, 60.0, clutter_density=1e-4)
    assert (tracker.state.clutter.density, tracker.state.clutter.looks) == (0.0, 0.0)
