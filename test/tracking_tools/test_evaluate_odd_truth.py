# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check that tracks are judged as they are, whatever they or the truth leave out."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.testing import assert_allclose
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import Columns, from_columns
from tracking_tools.bags import BadBag, BagWriter, nanoseconds
from tracking_tools.evaluation import evaluate, Judgement, Yardstick
from tracking_tools.evaluation.text import to_text

PERIOD, SCANS, EPOCH = 4.0, 50, 1000.0
RADAR = '/radar_tracker/tracks'
WriteBag = Callable[[str, str, list[tuple[float, Columns]]], Path]


@pytest.fixture
def write_bag(tmp_path: Path) -> WriteBag:
    """Return a function that writes tables with their stamps to a topic."""

    def write_bag(name: str, topic: str, tables: list[tuple[float, Columns]]) -> Path:
        with BagWriter(tmp_path / name) as bag:
            for time, columns in tables:
                msg = from_columns(columns, EPOCH + time, 'map', rosbags_types())
                bag.write(topic, msg, nanoseconds(EPOCH + time))
        return tmp_path / name

    return write_bag


def state(time: float, height: float = 8000.0) -> Columns:
    """Return where two contacts are that fly east at 100 m/s."""
    east, one = 100.0 * time + np.zeros(2), np.ones(2)
    return {
        'id': np.array([1, 2], np.uint32), 'x': east, 'y': np.array([0.0, 20e3]),
        'z': height * one, 'vx': 100.0 * one, 'vy': 0.0 * one, 'vz': 0.0 * one,
    }  # fmt: skip


def tracked(late: float = 0.0) -> list[tuple[float, Columns]]:
    """Return perfect tracks of both; rows are of a moment later than the stamps."""
    covariance = np.tile((100.0 * np.eye(6)).reshape(1, 36), (2, 1))
    return [
        (
            PERIOD * k,
            {
                **state(PERIOD * k + late), 'time': np.full(2, late, np.float32),
                'status': np.ones(2, np.uint8), 'covariance': covariance,
            },
        )
        for k in range(SCANS)
    ]  # fmt: skip


def circle(time: float) -> Columns:
    """Return where both are that circle with a radius of 1000 m at 4 deg/s."""
    turn = np.radians(4.0)
    east, north = np.cos(turn * time), np.sin(turn * time)
    speed = 1000.0 * turn * np.ones(2)
    return {**state(time), 'x': 1000.0 * east * np.ones(2), 'vx': -speed * north,
            'y': 1000.0 * north + np.array([0.0, 20e3]), 'vy': speed * east}  # fmt: skip


def perfect(found: Judgement) -> None:
    """Check that nothing is missed or false."""
    assert found.held.coverage == 1.0
    assert (found.held.breaks, found.held.id_switches, found.held.false_tracks) == (0, 0, 0)
    assert found.held.relative_tracking_time == 1.0
    assert found.gospa.rms < 1.0
    assert found.ospa.mean < 1.0


def test_truth_without_heights_is_compared_over_the_ground(write_bag: WriteBag) -> None:
    """Tracks in 3-D, truth of x and y; the text says so. With heights they are compared."""
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked())
    flat = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    for _, columns in flat:
        del columns['z']
    found = evaluate(tracks, write_bag('flat', '/truth', flat))
    perfect(found)
    assert 'over the ground' in to_text(found)
    high = [(PERIOD * k, state(PERIOD * k, 5000.0)) for k in range(SCANS)]
    assert evaluate(tracks, write_bag('high', '/truth', high)).held.coverage == 0.0


@pytest.mark.parametrize('name', ['vx', 'z', 'y'])
def test_what_the_truth_does_not_know_is_left_out(write_bag: WriteBag, name: str) -> None:
    """NaN in some rows: velocities come from the places, heights go, rows without a place go."""
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    for k, (_, columns) in enumerate(tables[1:-1]):
        columns[name][k % 2] = np.nan
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked())
    perfect(evaluate(tracks, write_bag('truth', '/truth', tables)))


def test_contact_in_two_places_at_one_time_is_refused(write_bag: WriteBag) -> None:
    """Two contacts of one id: the first row was taken, and the other contact was none."""
    tracks = write_bag('tracks', RADAR, tracked())
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    perfect(evaluate(tracks, write_bag('twice', '/truth', [*tables, *tables])))
    for _, columns in tables:
        columns['id'][:] = 1
    with pytest.raises(BadBag, match=r'contact 1 of the truth is in two places at 1.* 20000 m'):
        evaluate(tracks, write_bag('one_id', '/truth', tables))


@pytest.mark.parametrize('again', [slice(None), slice(3, 4)])
@pytest.mark.parametrize(('name', 'more'), [('id', np.uint32(2)), ('x', 50.0)])
def test_two_tables_of_one_moment_are_refused(
    write_bag: WriteBag, again: slice, name: str, more: float
) -> None:
    """A bag that looped while it was recorded, or a second tracker on the topic."""
    other = [(time, {**table, name: table[name] + more}) for time, table in tracked()[again]]
    tracks = write_bag('tracks', RADAR, [*tracked(), *other])
    truth = write_bag('truth', '/truth', [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)])
    words = f'{RADAR} has {SCANS + len(other)} different tables, but of {SCANS} moments: were the'
    with pytest.raises(BadBag, match=words):
        evaluate(tracks, truth)


def test_truth_without_a_single_place_is_refused(write_bag: WriteBag) -> None:
    """Says which columns a row must have."""
    tables = [(0.0, {**state(0.0), 'x': np.full(2, np.nan)})]
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked())
    with pytest.raises(BadBag, match='numbers in all of id, x, y'):
        evaluate(tracks, write_bag('truth', '/truth', tables))


def test_short_dropouts_of_a_fast_truth_are_no_absence(write_bag: WriteBag) -> None:
    """Once a second with gaps of three: no scan without it, and none that counts twice."""
    seconds = [t for t in range(int(PERIOD) * SCANS) if t % 20 not in (5, 6)]
    tables = [(float(t), state(float(t))) for t in seconds]
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked())
    perfect(evaluate(tracks, write_bag('truth', '/truth', tables)))


def test_row_just_after_the_last_sample_counts(write_bag: WriteBag) -> None:
    """As a track's time is that of the plot, and a truth's that of its message."""
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked(late=0.003))
    perfect(evaluate(tracks, write_bag('truth', '/truth', tables)))


def test_time_before_the_recording_does_not_count(write_bag: WriteBag) -> None:
    """There long before, away, and back in scan 10: confirmed at once, there for 40 scans."""
    early = [(-1000.0 + 4.0 * k, state(-1000.0 + 4.0 * k)) for k in range(30)]
    back = [(PERIOD * k, state(PERIOD * k)) for k in range(10, SCANS)]
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked()[10:])
    found = evaluate(tracks, write_bag('truth', '/truth', early + back))
    assert found.timing.time_to_confirm_mean == 0.0
    assert_allclose([c.duration for c in found.per_contact], PERIOD * (SCANS - 11))


def test_radius_may_be_a_whole_number(write_bag: WriteBag) -> None:
    """Distances keep their fractions."""
    tables = [(PERIOD * k, state(PERIOD * k, 8000.9)) for k in range(SCANS)]
    tracks = write_bag('tracks', '/radar_tracker/tracks', tracked())
    found = evaluate(tracks, write_bag('truth', '/truth', tables), Yardstick(radius=50))
    assert_allclose([found.ospa.mean, found.accuracy.rmse], 0.9, atol=1e-3)


@pytest.mark.parametrize('value', [0.0, -100.0, np.nan])
def test_covariance_that_is_none_costs_the_nees_only(write_bag: WriteBag, value: float) -> None:
    """Of a tracker that does not know it in some rows: those are left out, all else is judged."""
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    tracks = tracked()
    for _, columns in tracks[::2]:
        columns['covariance'] = np.tile((value * np.eye(6)).reshape(1, 36), (2, 1))
        columns['x'] = columns['x'] + 10.0
    found = evaluate(write_bag('tracks', RADAR, tracks), write_bag('truth', '/truth', tables))
    assert found.held.coverage == 1.0
    assert_allclose(found.accuracy.rmse, np.sqrt(50.0), rtol=1e-3)
    assert found.dimensions == 3
    assert (found.nees_position.samples, found.nees_state.samples) == (SCANS, SCANS)
    assert_allclose(found.nees_position.mean, 0.0, atol=1e-6)
    assert_allclose(found.per_contact[0].accuracy.nees_state, 0.0, atol=1e-6)


@pytest.mark.parametrize('name', ['x', 'z', 'vx'])
def test_row_of_a_track_without_a_number_is_judged_as_far_as_it_goes(
    write_bag: WriteBag, name: str
) -> None:
    """Without a place it is left out, without a height all are compared over the ground."""
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    tracks = tracked()
    tracks[9][1][name][0] = np.nan
    found = evaluate(write_bag('tracks', RADAR, tracks), write_bag('truth', '/truth', tables))
    assert_allclose(found.held.coverage, 1.0 - (name == 'x') / (2 * SCANS))
    assert found.dimensions == (2 if name == 'z' else 3)
    assert_allclose(found.accuracy.rmse, 0.0, atol=1e-3)


def test_truth_that_is_shorter_or_told_seldom_is_said_so(write_bag: WriteBag) -> None:
    """Tracks before it count as false; turns between two samples are errors of the truth."""
    tracks = write_bag('tracks', RADAR, tracked())
    late = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS // 2, SCANS)]
    found = evaluate(tracks, write_bag('late', '/truth', late))
    assert_allclose(found.outside, 0.5, atol=0.03)
    assert 'rows of tracks are from before or after all truth' in to_text(found)
    assert (found.truth_error, 'known to' in to_text(found)) == (0.0, False)
    flown = [(time, {**table, **circle(time)}) for time, table in tracked()]
    seldom = [(40.0 * k, circle(40.0 * k)) for k in range(6)]
    found = evaluate(write_bag('flown', RADAR, flown), write_bag('seldom', '/truth', seldom))
    assert found.accuracy.rmse > 50.0
    assert f'known to some {found.truth_error:.1f} m only' in to_text(found)


def test_tables_that_were_recorded_twice_count_once(write_bag: WriteBag) -> None:
    """By two recorders into one bag; they were id switches, as each contact had two tracks."""
    truth = write_bag('truth', '/truth', [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)])
    tracks = [table for table in tracked() for _ in range(2)]
    perfect(found := evaluate(write_bag('tracks', RADAR, tracks), truth))
    assert found.siap.ambiguity == 1.0
    assert found.per_track[0].rows == SCANS


def test_two_tracks_on_each_contact_are_told(write_bag: WriteBag) -> None:
    """As of contacts of several plots; figures of the nearer one tell half of it."""
    truth = write_bag('truth', '/truth', [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)])
    both = [
        (time, {name: np.concatenate([part, part + np.uint32(2) if name == 'id' else part])
                for name, part in table.items()})
        for time, table in tracked()
    ]  # fmt: skip
    assert 'contacts have 2.0 tracks at a time' in to_text(
        evaluate(write_bag('both', RADAR, both), truth)
    )


def test_covariance_of_another_size_is_refused(write_bag: WriteBag) -> None:
    """Says which, and how many numbers it must have."""
    tracks = tracked()
    for _, columns in tracks:
        columns['covariance'] = np.tile(np.eye(3).reshape(1, 9), (2, 1))
    bag = write_bag('tracks', RADAR, tracks)
    with pytest.raises(BadBag, match=r'of /radar_tracker/tracks .* must have 36 values, got 9'):
        evaluate(bag, write_bag('truth', '/truth', [(0.0, state(0.0))]))


@pytest.mark.parametrize(
    ('number', 'why'), [(211234561.0, '16777216, got 211234560'), (1.5, '1.5')]
)
def test_ids_that_a_float_cannot_hold_are_refused(
    write_bag: WriteBag, number: float, why: str
) -> None:
    """Two ships with MMSI in float32 would be one, and the track of the other a false one."""
    tables = [(PERIOD * k, state(PERIOD * k)) for k in range(SCANS)]
    for _, columns in tables:
        columns['id'] = np.array([number, number + 6.0], np.float32)
    tracks = write_bag('tracks', RADAR, tracked())
    with pytest.raises(BadBag, match=f'ids of the truth are float32 .*{why}'):
        evaluate(tracks, write_bag('truth', '/truth', tables))
    for k, (_, columns) in enumerate(tables):
        columns['id'] = np.array([1.0, 2.0**24], np.float64 if k % 2 else np.float32)
    perfect(evaluate(tracks, write_bag('exact', '/truth', tables)))
