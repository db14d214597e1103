# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of more than one turn of the antenna, and of one that never came."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

PERIOD = 4.0
SITE = {
    'lifecycle': 'm_of_n',
    'm_of_n.drop_misses': 3,
    'merge.looks': 1,
    'scan.period': PERIOD,
    'sensor.range_max': 40_000.0,
}
# Contacts at rest, by the part of a turn after which the antenna passes them.
FADED, TWICE, CUT, GONE, ONCE = PARTS = (0.05, 0.15, 0.3, 0.45, 0.7)


both_ways = pytest.mark.parametrize('sense', [1.0, -1.0], ids=['anticlockwise', 'clockwise'])


def message(
    first: float, last: float, silent: dict[float, float] | None = None, sense: float = 1.0
) -> Plots:
    """Return the plots from one turn to another, of the silent contacts up to a turn only."""
    passes = [
        (turn + part, part)
        for turn in range(int(first), int(np.ceil(last)))
        for part in PARTS
        if first <= turn + part < min(last, (silent or {}).get(part, np.inf))
    ]
    turns, parts = np.array(sorted(passes)).reshape(-1, 2).T
    plots = Plots.polar(PERIOD * turns, np.full(len(turns), 20_000.0), sense * 2.0 * np.pi * parts)
    return replace(plots, stamp=PERIOD * first)


def followed(turns: int, silent: dict[float, float], sense: float = 1.0) -> RadarTracker:
    """Return a tracker after messages of one turn each."""
    tracker = RadarTracker(with_values(RadarTrackerConfig(), SITE))
    for turn in range(turns):
        tracker.track(message(turn, turn + 1, silent, sense))
    return tracker


def by_part(tracker: RadarTracker, column: str, sense: float = 1.0) -> dict[float, int]:
    """Return a column of the tracks by where the antenna passes them."""
    place = tracker.tracks.planes[0].average[:, 0::2]
    part = sense * np.arctan2(place[:, 1], place[:, 0]) / (2.0 * np.pi) % 1.0
    values = getattr(tracker.tracks, column).tolist()
    return dict(zip(np.round(part, 3).tolist(), values, strict=True))


def test_second_pass_in_a_message_is_a_look_like_any_other() -> None:
    """Both plots of a contact are its track's, both misses count, what has only begun waits."""
    silent = {GONE: 10.0, FADED: 11.0}
    tracker = followed(12, silent)
    ids, hits = by_part(tracker, 'id'), by_part(tracker, 'hits')
    assert by_part(tracker, 'misses') == {FADED: 1, TWICE: 0, CUT: 0, GONE: 2, ONCE: 0}

    tracker.track(message(12.0, 13.31, silent))
    report = tracker.state.report
    assert report.deleted.tolist() == [ids[GONE], ids[FADED]]  # of the first look, of the second
    assert by_part(tracker, 'id') == {part: ids[part] for part in (TWICE, CUT, ONCE)}
    assert by_part(tracker, 'misses') == {TWICE: 0, CUT: 0, ONCE: 0}
    after = by_part(tracker, 'hits')
    assert {p: after[p] - hits[p] for p in after} == {TWICE: 2, CUT: 1, ONCE: 1}
    # All plots are explained but the last, which waits: none is left for a new track.
    assert (report.plots, report.pairs, report.held, report.started) == (5, 4, 1, 0)
    assert len(tracker.state.seeds) == 0

    tracker.track(message(13.31, 14.31, silent))
    assert by_part(tracker, 'id') == {part: ids[part] for part in (TWICE, CUT, ONCE)}
    assert by_part(tracker, 'hits')[CUT] > after[CUT]
    assert_array_equal(tracker.tracks.misses, 0)


@both_ways
@pytest.mark.parametrize('turns', [2, 3, 6])
def test_every_pass_of_a_long_message_is_a_look(turns: int, sense: float) -> None:
    """Plots that were collected over some turns: all are used, as in messages of one turn."""
    tracker, end = followed(12, {}, sense), 12.31 + turns
    ids = by_part(tracker, 'id', sense)
    tracker.track(message(12.0, end, sense=sense))
    begun = {part: 12 + turns + (part < CUT) for part in PARTS}
    assert by_part(tracker, 'hits', sense) == begun
    assert (tracker.state.report.held, len(tracker.state.seeds)) == (1, 0)
    tracker.track(message(end, end + 1.0, sense=sense))
    assert by_part(tracker, 'hits', sense) == {part: hits + 1 for part, hits in begun.items()}
    assert by_part(tracker, 'id', sense) == ids
    assert_array_equal(tracker.tracks.misses, 0)


def test_first_look_of_a_long_message_counts_in_what_ends() -> None:
    """A second track beside a contact that was passed early, and a broken one, end at once."""
    tracker = followed(12, {})
    ids, places = by_part(tracker, 'id'), tracker.tracks.planes[0].average[:, 0::2]
    place = places[tracker.tracks.id == ids[ONCE]][0]
    double = tracker.start_track(place, PERIOD * (11.0 + ONCE))
    broken = ids[GONE]
    plane = tracker.tracks.planes[0]
    covariance = plane.covariance.copy()
    covariance[tracker.tracks.id == broken] *= -1.0
    tracks = replace(tracker.tracks, planes=(replace(plane, covariance=covariance),))
    tracker.state = replace(tracker.state, tracks=tracks)

    tracker.track(message(12.0, 13.31))
    report = tracker.state.report
    assert (report.broken, report.merged) == (1, 1)
    assert report.deleted.tolist() == [broken, double]


@pytest.mark.parametrize('lost', [1, 3])
def test_turns_whose_messages_were_lost_are_no_misses(lost: int) -> None:
    """Nobody knows what the antenna saw meanwhile; then each track has its plot again."""
    tracker = followed(12, {})
    ids, hits = by_part(tracker, 'id'), by_part(tracker, 'hits')
    tracker.track(message(12.0 + lost, 13.0 + lost))
    assert by_part(tracker, 'id') == ids
    assert by_part(tracker, 'hits') == {part: hits[part] + 1 for part in PARTS}
    assert_array_equal(tracker.tracks.history & 0b11, 0b11)  # the last two looks have plots
