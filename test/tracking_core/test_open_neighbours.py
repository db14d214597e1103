# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts beside each other, a message that ends between them: who waits, and for how long?"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

PERIOD = 4.0
SITE = {
    'scan.period': PERIOD,
    'scan.assembly': 'sector',
    'sensor.range_max': 40_000.0,
    'clutter_density': 1e-9,
    'motion.horizontal.acceleration_sd': [1.0, 10.0],
    'initiation.speed_max': 20.0,
}


def plots(contacts, first: float, last: float) -> Plots:
    """Return what the antenna passes from one turn to another; contacts are (part, range)."""
    passes = sorted(
        (turn + part, distance)
        for turn in range(int(first), int(np.ceil(last)))
        for part, distance in contacts
        if first <= turn + part < last
    )
    turns, distance = np.array(passes).reshape(-1, 2).T
    made = Plots.polar(PERIOD * turns, distance, 2.0 * np.pi * turns % (2.0 * np.pi))
    return replace(made, stamp=PERIOD * first)


def tracker_of(contacts, turns: int, cuts: int, azimuth_sd: float = 0.00175) -> RadarTracker:
    """Return a tracker after some turns, each in so many messages."""
    site = {**SITE, 'sensor.azimuth_sd': azimuth_sd}
    tracker = RadarTracker(with_values(RadarTrackerConfig(), site))
    edges = np.arange(turns * cuts + 1) / cuts
    for first, last in pairwise(edges):
        tracker.track(plots(contacts, first, last))
    return tracker


def test_track_waits_for_its_neighbour_whose_gate_is_still_open() -> None:
    """It is missed, the other's plot is in its gate, and the message ends: the plot is not its."""
    missed, seen = (0.5, 20_000.0), (0.5025, 20_000.0)
    elsewhere = [(part, 30_000.0) for part in (0.1, 0.3, 0.5050, 0.8)]
    tracker = tracker_of([missed, seen, *elsewhere], 20, cuts=4)
    hits = {part: tracker.tracks.hits[parts(tracker) == part] for part in (0.5, 0.5025)}
    contacts = [seen, *elsewhere]
    tracker.track(plots(contacts, 20.0, 20.51))  # the last plot is between the ends of both gates
    tracker.track(plots(contacts, 20.51, 21.0))
    now = tracker.tracks
    assert now.misses[parts(tracker) == 0.5] == 1
    assert now.hits[parts(tracker) == 0.5025] == hits[0.5025] + 1


def test_nobody_waits_for_long_in_a_ring_of_neighbours() -> None:
    """Each waits for the next one, all the way round, but for a quarter of a turn at most."""
    ring = [(k / 36.0 + 0.005, 3_000.0) for k in range(36)]
    tracker = tracker_of(ring, 12, cuts=8, azimuth_sd=0.05)
    since = 12.0 - tracker.tracks.time / PERIOD
    assert len(since) >= len(ring)
    # A turn since the last pass, an eighth for the own gate, a quarter for the others', and the
    # eighth that a message is long. Without the bound nobody is ever looked at.
    assert since.max() < 1.5


def parts(tracker: RadarTracker) -> np.ndarray:
    """Return where the antenna passes the tracks."""
    place = tracker.tracks.planes[0].average[:, 0::2]
    return np.round(np.arctan2(place[:, 1], place[:, 0]) / (2.0 * np.pi) % 1.0, 4)
